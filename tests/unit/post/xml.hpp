#pragma once
#include <expat.h>

#include <memory>
#include <string>

/// XML as any parser sees it, not the reader that belongs to the writer and is lenient with it.
namespace xml {

/// What keeps the text from being well-formed, with its place; empty if nothing does.
inline std::string error(const std::string& text) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), XML_ParserFree);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1) == XML_STATUS_OK) return "";
  return std::string(XML_ErrorString(XML_GetErrorCode(parser.get()))) + " in line " +
         std::to_string(XML_GetCurrentLineNumber(parser.get()));
}

}  // namespace xml
