#include "post/files/xml_text.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkXMLWriter.h>

#include <stdexcept>

namespace post {

std::string xml_text(vtkXMLWriter& writer, const std::string& what) {
  vtkNew<vtkCallbackCommand> silent;  // without it VTK prints to the terminal what is thrown below
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer.AddObserver(vtkCommand::ErrorEvent, silent);
  writer.SetDataModeToBinary();
  writer.SetCompressorTypeToZLib();
  writer.SetCompressionLevel(1);
  writer.WriteToOutputStringOn();
  if (writer.Write() == 0 || writer.GetErrorCode() != vtkErrorCode::NoError)
    throw std::runtime_error(fmt::format("VTK cannot write the {}: error {}", what, writer.GetErrorCode()));
  return writer.GetOutputString();
}

}  // namespace post
