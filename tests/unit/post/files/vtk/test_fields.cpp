#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <catch2/catch.hpp>

#include "post/factors/srif.hpp"
#include "post/files/vtk/series.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/xml.hpp"

using small_run::FullDisk, small_run::TemporaryFolder, small_run::text_of;

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

TEST_CASE("fields.pvd lists every frame with its time") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  series.write(small_run::frame(0, 0));
  series.write(small_run::frame(1e-5, 1));
  const std::string text = text_of(folder / "fields.pvd");
  CHECK_THAT(text, Catch::Contains("timestep=\"0\" part=\"0\" file=\"fields_0000.vtu\""));
  CHECK_THAT(text, Catch::Contains("timestep=\"1e-05\" part=\"0\" file=\"fields_0001.vtu\""));
  CHECK_THAT(text, Catch::EndsWith("</VTKFile>\n"));
  CHECK(folder.entries() == 3);
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

TEST_CASE("cracks that change are a series beside the fields") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  for (const double time : {0.0, 0.5}) {
    auto frame = small_run::frame(time, 0);
    frame.cracks = post::Cracks{{{{{0, 0}, {1, time}}, {0, time}}}, {}};
    series.write(frame);
  }
  CHECK_THAT(text_of(folder / "cracks.pvd"), Catch::Contains("timestep=\"0.5\" part=\"0\" file=\"cracks_0001.vtp\""));
  CHECK(folder.entries() == 6);
}

TEST_CASE("cracks come back from their vtp file") {
  const TemporaryFolder folder;
  post::Cracks cracks{{{{{0, 1.0 / 3}, {2, 3}}, {0, 4}}, {{{5, 6}, {7, 8}, {9, 1e-17}}, {1, 2, 3}}},
                      {{7, 1, {9, 1e-17}, {}}, {3, 0, {2, 3}, {}}}};
  post::Srif first, second;
  first.tip = second.tip = 3;
  first.K1 = 0.25, first.K2 = -1, first.resolved[2] = false, second.K1 = 5;
  post::set_factors(cracks, {first, second});
  post::write_cracks(folder / "cracks.vtp", cracks);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "cracks.vtp").c_str());
  reader->Update();
  vtkPolyData& lines = *reader->GetOutput();

  REQUIRE(lines.GetNumberOfPoints() == 7);
  CHECK(lines.GetPoint(0)[1] == 1.0 / 3);
  CHECK(lines.GetPoint(4)[1] == 1e-17);
  REQUIRE(lines.GetNumberOfLines() == 2);
  REQUIRE(lines.GetNumberOfVerts() == 2);
  CHECK(lines.GetCell(3)->GetNumberOfPoints() == 3);  // VTK counts vertices first
  CHECK(lines.GetCell(3)->GetPointId(0) == 2);
  const auto of_cell = [&](const char* name, int i) { return lines.GetCellData()->GetArray(name)->GetComponent(i, 0); };
  const auto of_point = [&](const char* name, int i) {
    return lines.GetPointData()->GetArray(name)->GetComponent(i, 0);
  };
  CHECK(of_cell("tip", 0) == 7);
  CHECK(of_cell("crack", 0) == 1);
  CHECK(of_cell("crack", 3) == 1);
  CHECK(of_cell("tip", 3) == -1);
  CHECK(of_point("advance", 1) == 4);
  CHECK(lines.GetCell(1)->GetPointId(0) == 6);
  CHECK(lines.GetPoint(6)[0] == 2);
  CHECK(of_point("tip", 6) == 3);
  CHECK(of_point("K1", 6) == 0.25);
  CHECK(of_point("K2", 6) == -1);
  CHECK(std::isnan(of_point("K3", 6)));
  CHECK(std::isnan(of_point("K1", 5)));
  CHECK(std::isnan(of_point("K1", 0)));
}

TEST_CASE("what ParaView reads is well-formed XML") {
  CHECK(xml::fault("<a>\n<b></a>") == "mismatched tag in line 2");
  CHECK(xml::fault(std::string("<a>\0</a>", 8)) == "not well-formed (invalid token) in line 1");
  const TemporaryFolder folder;
  post::VtkSeries(folder.path(), small_run::mesh()).write(small_run::frame(0.25, 3));
  post::write_cracks(folder / "cracks.vtp", {{{{{0, 1}, {2, 3}}, {0, 4}}}, {{0, 0, {2, 3}, {}}}});
  post::write_cracks(folder / "none.vtp", {});
  REQUIRE(folder.entries() == 4);
  for (const char* name : {"fields_0000.vtu", "fields.pvd", "cracks.vtp", "none.vtp"}) {
    INFO(name);
    CHECK(xml::fault(text_of(folder / name)) == "");
  }
}

TEST_CASE("a frame that cannot be written is an error and leaves no file") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  CHECK_THROWS_WITH(series.write(small_run::frame(0, 0, 5)), "w has 5 values for 6 points");
  const FullDisk full(1000);
  CHECK_THROWS_AS(series.write(small_run::frame(0, 0)), std::filesystem::filesystem_error);
  CHECK(folder.entries() == 0);
}
