#pragma once
#include <functional>
#include <string>
#include <vector>

namespace plate {
struct Section;
}

namespace post {

struct FaceOverlaps;
struct Table;

/// Overlaps of the faces behind each tip from the rows of srif.csv, by the recommended method: where they overlap at
/// z > 0 (K1 < 0) and when that changes. A K1 below a thousandth of the largest of its tip has no sign.
std::vector<FaceOverlaps> face_overlaps(const Table& srifs);

/// A line for every crack with a tip that has or had K1 < 0. `crack` of a tip; without it all tips are one crack's.
/// `row`: the words for a row, by its time; without it there is one row. `may_touch`: the run could find contact.
std::vector<std::string> warnings_about_faces(const std::vector<FaceOverlaps>& found, const plate::Section& section,
                                              const std::function<std::size_t(std::size_t tip)>& crack,
                                              const std::function<std::string(double time)>& row, bool may_touch);
/// Names the value to set where faces overlap.
const char* remedy_of_overlaps(bool may_touch);

}  // namespace post
