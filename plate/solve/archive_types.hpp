#pragma once

namespace cereal {
class BinaryOutputArchive;
class BinaryInputArchive;
}  // namespace cereal

/// To what the memory of a run is written, and from what it is read (archive.hpp).
namespace plate {

using OutArchive = cereal::BinaryOutputArchive;
using InArchive = cereal::BinaryInputArchive;

}  // namespace plate
