#pragma once

namespace cereal {
class BinaryOutputArchive;
class BinaryInputArchive;
}  // namespace cereal

/// Archives to which the checkpoint of a run is written, and from which it is read (archive.hpp).
namespace plate {

using OutArchive = cereal::BinaryOutputArchive;
using InArchive = cereal::BinaryInputArchive;

}  // namespace plate
