#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>

#include "post/files/files.hpp"
#include "post/files/vtk/xml_text.hpp"

namespace post {
namespace {

/// Arrays of numbers with names, a row at a time.
template <std::size_t N>
class Columns {
public:
  explicit Columns(const std::array<const char*, N>& names) {
    for (std::size_t i = 0; i < N; ++i) arrays_[i]->SetName(names[i]);
  }
  void add(const std::array<double, N>& row) {
    for (std::size_t i = 0; i < N; ++i) arrays_[i]->InsertNextValue(row[i]);
  }
  void give_to(vtkDataSetAttributes& data) {
    for (auto& array : arrays_) data.AddArray(array);
  }

private:
  std::array<vtkNew<vtkDoubleArray>, N> arrays_;
};

}  // namespace

std::string vtp(const Cracks& cracks) {
  constexpr double none = -1;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines, tips;
  Columns<2> of_cells({"crack", "tip"});  // those of vertices come first, as VTK counts cells
  Columns<5> of_points({"advance", "tip", "K1", "K2", "K3"});
  for (const auto& tip : cracks.tips) of_cells.add({double(tip.crack), double(tip.number)});
  for (const auto& line : cracks.lines) {
    lines->InsertNextCell(static_cast<int>(line.vertices.size()));
    of_cells.add({double(&line - cracks.lines.data()), none});
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      lines->InsertCellPoint(points->InsertNextPoint(line.vertices[i].x(), line.vertices[i].y(), 0));
      of_points.add({line.advances[i], none, NAN, NAN, NAN});
    }
  }
  for (const auto& tip : cracks.tips) {
    const vtkIdType at = points->InsertNextPoint(tip.position.x(), tip.position.y(), 0);
    tips->InsertNextCell(1, &at);
    const auto [K1, K2, K3] = tip.factors.value_or(std::array<double, 3>{NAN, NAN, NAN});
    of_points.add({0, double(tip.number), K1, K2, K3});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(tips);
  data->SetLines(lines);
  of_cells.give_to(*data->GetCellData());
  of_points.give_to(*data->GetPointData());

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  return xml_text(*writer, "cracks");
}

}  // namespace post
