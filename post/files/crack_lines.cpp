#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "post/files/files.hpp"
#include "post/files/xml_text.hpp"

namespace post {

std::string vtp(const std::vector<CrackLine>& cracks) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> crack, advance;
  crack->SetName("crack");
  advance->SetName("advance");
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    lines->InsertNextCell(static_cast<int>(cracks[c].vertices.size()));
    crack->InsertNextValue(double(c));
    for (std::size_t i = 0; i < cracks[c].vertices.size(); ++i) {
      lines->InsertCellPoint(points->InsertNextPoint(cracks[c].vertices[i].x(), cracks[c].vertices[i].y(), 0));
      advance->InsertNextValue(cracks[c].advances[i]);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->AddArray(crack);
  data->GetPointData()->AddArray(advance);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  return xml_text(*writer, "cracks");
}

}  // namespace post
