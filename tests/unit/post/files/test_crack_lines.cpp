#include "post/files/vtk_series.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "post/factors/srif.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder;

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
