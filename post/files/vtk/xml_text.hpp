#pragma once
#include <string>

class vtkObject;
class vtkXMLWriter;

namespace post {

/// Without it VTK prints to the terminal what its callers throw.
void keep_quiet(vtkObject& object);

/// What the writer has to say of its input, as text: the disk is met in write_whole alone, which knows what to do when
/// it is full. Arrays are compressed and stand inline in base64, so that the text is well-formed XML: raw appended
/// arrays are not, and a strict parser refuses them ("invalid token": expat 2.5.0-1+deb12u2, which ParaView of Debian
/// 12 uses). Throws std::runtime_error, naming `what`.
std::string xml_text(vtkXMLWriter& writer, const std::string& what);

}  // namespace post
