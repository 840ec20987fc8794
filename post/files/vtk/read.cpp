#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <stdexcept>

#include "post/files/files.hpp"
#include "post/files/vtk/xml_text.hpp"

namespace post {
namespace {

/// One row per component and one column per point; empty where there is no such array.
Eigen::MatrixXd values(vtkPointData& data, const char* name) {
  vtkDataArray* const array = data.GetArray(name);
  if (!array) return {};
  Eigen::MatrixXd result(array->GetNumberOfComponents(), array->GetNumberOfTuples());
  for (Eigen::Index k = 0; k < result.cols(); ++k) array->GetTuple(k, result.col(k).data());
  return result;
}

Mesh mesh_of(vtkUnstructuredGrid& grid) {
  Mesh mesh;
  for (vtkIdType k = 0; k < grid.GetNumberOfPoints(); ++k) {
    const double* const x = grid.GetPoint(k);
    mesh.positions.emplace_back(x[0], x[1]);
  }
  for (vtkIdType k = 0; k < grid.GetNumberOfCells(); ++k) {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    grid.GetCellPoints(k, size, ids);
    const auto id = [&](int i) { return std::uint32_t(ids[i]); };
    if (size == 4) mesh.quads.push_back({id(0), id(1), id(2), id(3)});
    if (size == 3) mesh.triangles.push_back({id(0), id(1), id(2)});
  }
  return mesh;
}

Frame frame_of(vtkUnstructuredGrid& grid) {
  vtkPointData& data = *grid.GetPointData();
  const auto w = values(data, "w"), theta = values(data, "theta"), damage = values(data, "damage");
  if (w.rows() != 1 || theta.rows() != 2) throw std::runtime_error("no w and theta");
  Frame frame;
  frame.state.resize(3, w.cols());
  frame.state << w, theta;
  frame.damage.assign(damage.data(), damage.data() + damage.size());
  if (const auto von_mises = values(data, "von_mises"); von_mises.size() > 0) {
    const auto xx = values(data, "Mxx"), yy = values(data, "Myy"), xy = values(data, "Mxy");
    for (const auto* one : {&von_mises, &xx, &yy, &xy})
      if (one->rows() != 1) throw std::runtime_error("von_mises without the moments Mxx, Myy and Mxy");
    frame.resultants.von_mises = von_mises.transpose();
    frame.resultants.moments.resize(3, w.cols());
    frame.resultants.moments << xx, yy, xy;
  }
  if (auto* const time = grid.GetFieldData()->GetArray("TimeValue")) frame.time = time->GetTuple1(0);
  return frame;
}

}  // namespace

Drawn read_vtu(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  keep_quiet(*reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  try {
    if (reader->GetErrorCode() != vtkErrorCode::NoError) throw std::runtime_error("VTK cannot read it");
    return {mesh_of(grid), frame_of(grid)};
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace post
