#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include "cases/python/door.hpp"
#include "plate/solve/interruption.hpp"

namespace py = pybind11;
namespace door = cases::door;

namespace {

/// The values go to Python without a copy; one axis where rows are of one value.
template <typename T>
py::array_t<T> to_numpy(std::vector<T>&& values, std::size_t width) {
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* one) { delete static_cast<std::vector<T>*>(one); });
  std::vector<py::ssize_t> shape{py::ssize_t(kept->size() / width)};
  if (width > 1) shape.push_back(py::ssize_t(width));
  return py::array_t<T>(shape, kept->data(), owner);
}

py::dict to_python(post::ResultsInMemory&& run) {
  py::dict tables, parts;
  py::list frames, cracks;
  for (const auto& [name, table] : run.tables) tables[py::str(name)] = py::make_tuple(table.columns, table.rows);
  for (auto& [time, arrays, quads, triangles] : run.frames) {
    py::dict frame;
    for (auto& [name, array] : arrays) frame[py::str(name)] = to_numpy(std::move(array.values), array.width);
    frame["time"] = time;
    frame["quads"] = to_numpy(std::move(quads), 4), frame["triangles"] = to_numpy(std::move(triangles), 3);
    frames.append(frame);
  }
  for (auto& line : run.cracks) cracks.append(to_numpy(std::move(line.values), line.width));
  for (auto& [name, part] : run.parts) parts[py::str(name)] = to_python(std::move(part));
  py::dict result;
  result["summary"] = run.summary, result["resolved"] = run.resolved;
  result["tables"] = tables, result["frames"] = frames, result["cracks"] = cracks, result["parts"] = parts;
  return result;
}

}  // namespace

/// Raw calls; the package around it (pdplate/__init__.py) gives them their form.
PYBIND11_MODULE(_door, module) {
  static py::exception<door::Wrong> wrong(module, "Wrong", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const door::Wrong& error) {
      PyErr_SetObject(wrong.ptr(), py::make_tuple(error.what(), error.problems).ptr());
    } catch (const plate::Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  module.def("run",
             [](std::string path, std::string text, std::vector<std::string> overrides, bool fields, int threads) {
               door::Run run;
               {
                 const py::gil_scoped_release others_go_on;
                 run = door::run({std::move(path), std::move(text), std::move(overrides)}, fields, threads);
               }
               return py::make_tuple(to_python(std::move(run.in_memory)), run.failure);
             });
  module.def("check", [](std::string path, std::string text, std::vector<std::string> overrides, int threads) {
    const py::gil_scoped_release others_go_on;
    return door::check({std::move(path), std::move(text), std::move(overrides)}, threads);
  });
  module.def("keys", &door::keys);
  module.def("version", &door::version);
}
