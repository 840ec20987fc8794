#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "post/files/vtk_series.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::FullDisk, small_run::TemporaryFolder;

namespace {

/// The components of a point array, one row each.
Eigen::MatrixXd values(vtkUnstructuredGrid& grid, const char* name) {
  vtkDataArray* array = grid.GetPointData()->GetArray(name);
  if (!array) throw std::runtime_error(std::string("no array ") + name);
  CHECK(array->GetDataType() == VTK_DOUBLE);
  Eigen::MatrixXd result(array->GetNumberOfComponents(), array->GetNumberOfTuples());
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    for (Eigen::Index i = 0; i < result.rows(); ++i) result(i, k) = array->GetComponent(k, static_cast<int>(i));
  }
  return result;
}

}  // namespace

TEST_CASE("a frame comes back from its vtu file") {
  const TemporaryFolder folder;
  const post::Frame frame = small_run::frame(0.25, 3);
  post::VtkSeries(folder.path(), small_run::mesh()).write(frame);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "fields_0000.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();

  REQUIRE(grid.GetNumberOfPoints() == 6);
  CHECK(grid.GetPoint(4)[0] == 2);
  CHECK(grid.GetPoint(4)[1] == 0.5);
  REQUIRE(grid.GetNumberOfCells() == 3);
  CHECK(grid.GetCellType(0) == VTK_QUAD);
  CHECK(grid.GetCellType(1) == VTK_TRIANGLE);
  CHECK(grid.GetCellType(2) == VTK_VERTEX);
  CHECK(grid.GetCell(1)->GetPointId(1) == 4);
  CHECK(grid.GetCell(2)->GetPointId(0) == 5);

  CHECK(grid.GetPointData()->GetNumberOfArrays() == 11);
  CHECK(values(grid, "w") == frame.state.row(0));
  CHECK(values(grid, "theta") == frame.state.bottomRows<2>());
  CHECK(values(grid, "damage") == Eigen::MatrixXd::Constant(1, 6, 0.125));
  CHECK(values(grid, "cut")(0, 3) == 0.3);
  CHECK(values(grid, "Mxx") == frame.resultants.moments.row(0));
  CHECK(values(grid, "Myy") == frame.resultants.moments.row(1));
  CHECK(values(grid, "Mxy") == frame.resultants.moments.row(2));
  CHECK(values(grid, "Qx") == frame.resultants.shear.row(0));
  CHECK(values(grid, "Qy") == frame.resultants.shear.row(1));
  CHECK(values(grid, "von_mises") == frame.resultants.von_mises.transpose());
  const Eigen::MatrixXd displacement = values(grid, "displacement");
  CHECK(displacement.topRows<2>().isZero(0));
  CHECK(displacement.row(2) == frame.state.row(0));
  REQUIRE(grid.GetFieldData()->GetArray("TimeValue"));
  CHECK(grid.GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0) == 0.25);
}

TEST_CASE("corners of cells take their values from the points that they name") {
  const TemporaryFolder folder;
  const post::Frame frame = small_run::frame(0, 0);
  post::Mesh mesh = small_run::mesh();
  mesh.corners = {{{3, 4}, {{1, 1.5, 0.25}, {4, -0.5, 0.75}}}};
  mesh.triangles.push_back({4, 6, 3});
  post::VtkSeries(folder.path(), mesh).write(frame);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "fields_0000.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  REQUIRE(grid.GetNumberOfPoints() == 7);
  CHECK(grid.GetPoint(6)[1] == 4);
  const Eigen::RowVectorXd w = frame.state.row(0), M = frame.resultants.moments.row(1);
  CHECK(values(grid, "w")(0, 6) == Approx(1.5 * w[1] - 0.5 * w[4]));
  CHECK(values(grid, "displacement")(2, 6) == Approx(1.5 * w[1] - 0.5 * w[4]));
  CHECK(values(grid, "Myy")(0, 6) == Approx(0.25 * M[1] + 0.75 * M[4]));
  CHECK(values(grid, "w").leftCols(6) == w);
}

TEST_CASE("a frame that cannot be written is an error and leaves no file") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  CHECK_THROWS_WITH(series.write(small_run::frame(0, 0, 5)), "w has 5 values for 6 points");
  const FullDisk full(1000);
  CHECK_THROWS_AS(series.write(small_run::frame(0, 0)), std::filesystem::filesystem_error);
  CHECK(folder.entries() == 0);
}
