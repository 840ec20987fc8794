#include "post/files/files.hpp"

#include <fmt/format.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <stdexcept>

#include "post/files/vertices.hpp"
#include "post/files/vtk/xml_text.hpp"

namespace post {
namespace {

template <typename Cells>
void insert(vtkUnstructuredGrid& grid, int type, const Cells& cells, std::vector<bool>& used) {
  for (const auto& cell : cells) {
    std::array<vtkIdType, std::tuple_size_v<typename Cells::value_type>> ids;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      ids[i] = cell[i];
      used.at(cell[i]) = true;
    }
    grid.InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
  }
}

void insert_points_and_cells(vtkUnstructuredGrid& grid, const Mesh& mesh) {
  const auto all = vertices(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) points->SetPoint(static_cast<vtkIdType>(k), all[k].x(), all[k].y(), 0);
  grid.SetPoints(points);
  grid.AllocateExact(static_cast<vtkIdType>(mesh.quads.size() + mesh.triangles.size()),
                     static_cast<vtkIdType>(4 * mesh.quads.size() + 3 * mesh.triangles.size()));
  std::vector<bool> used(all.size(), false);
  insert(grid, VTK_QUAD, mesh.quads, used);
  insert(grid, VTK_TRIANGLE, mesh.triangles, used);
  const auto own = mesh.positions.size() - mesh.others;
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (k >= own && k < mesh.positions.size()) continue;
    const auto id = static_cast<vtkIdType>(k);
    if (!used[k]) grid.InsertNextCell(VTK_VERTEX, 1, &id);
  }
}

/// Copies one row per component and one column per point, and finds those of corners; throws where the points are not
/// those of the mesh.
template <typename Rows>
void add_point_data(vtkUnstructuredGrid& grid, const Mesh& mesh, const char* name, CornerWeight weight,
                    const Eigen::MatrixBase<Rows>& rows) {
  const auto points = static_cast<Eigen::Index>(mesh.positions.size());
  if (rows.cols() != points)
    throw std::invalid_argument(fmt::format("{} has {} values for {} points", name, rows.cols(), points));
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(rows.rows()));
  array->SetNumberOfTuples(grid.GetNumberOfPoints());
  Eigen::Map<Eigen::MatrixXd> values(array->GetPointer(0), rows.rows(), grid.GetNumberOfPoints());
  values.leftCols(points) = rows;
  continue_to_corners(mesh, values, weight);
  grid.GetPointData()->AddArray(array);
}

Eigen::Map<const Eigen::RowVectorXd> row(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

void insert_fields(vtkUnstructuredGrid& grid, const Mesh& mesh, const Frame& frame) {
  const plate::Resultants& resultants = frame.resultants;
  const auto add = [&](const char* name, CornerWeight weight, const auto& rows) {
    add_point_data(grid, mesh, name, weight, rows);
  };
  constexpr auto linear = &Mesh::Source::linear, mean = &Mesh::Source::mean;
  add("w", linear, frame.state.row(0));
  add("theta", linear, frame.state.bottomRows<2>());
  add("damage", mean, row(frame.damage));
  add("cut", mean, row(mesh.cut));
  add("Mxx", mean, resultants.moments.row(0));
  add("Myy", mean, resultants.moments.row(1));
  add("Mxy", mean, resultants.moments.row(2));
  add("Qx", mean, resultants.shear.row(0));
  add("Qy", mean, resultants.shear.row(1));
  add("von_mises", mean, resultants.von_mises.transpose());
  Eigen::Matrix3Xd displacement = Eigen::Matrix3Xd::Zero(3, frame.state.cols());
  displacement.row(2) = frame.state.row(0);
  add("displacement", linear, displacement);

  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time);
  grid.GetFieldData()->AddArray(time);
}

std::string vtu(vtkUnstructuredGrid& grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  return xml_text(*writer, "fields");
}

}  // namespace

std::string vtu(const Mesh& mesh, const Frame& frame) {
  vtkNew<vtkUnstructuredGrid> grid;
  insert_points_and_cells(*grid, mesh);
  insert_fields(*grid, mesh, frame);
  return vtu(*grid);
}

}  // namespace post
