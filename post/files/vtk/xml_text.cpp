#include "post/files/vtk/xml_text.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkXMLWriter.h>

#include <stdexcept>

namespace post {

/// From the start: VTK also speaks of objects that it has no memory for, which nobody observes.
[[gnu::constructor]] static void turn_off_log() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

void keep_quiet(vtkObject& object) {
  vtkNew<vtkCallbackCommand> silent;
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  object.AddObserver(vtkCommand::ErrorEvent, silent);
}

std::string xml_text(vtkXMLWriter& writer, const std::string& what) {
  keep_quiet(writer);
  writer.SetDataModeToBinary();
  // zlib's fastest level takes 2.6 times as long for files of three quarters the size, as numbers hardly shrink
  writer.SetCompressorTypeToLZ4();
  writer.SetCompressionLevel(9);
  writer.WriteToOutputStringOn();
  if (writer.Write() == 0 || writer.GetErrorCode() != vtkErrorCode::NoError)
    throw std::runtime_error(fmt::format("VTK cannot write the {}: error {}", what, writer.GetErrorCode()));
  return writer.GetOutputString();
}

}  // namespace post
