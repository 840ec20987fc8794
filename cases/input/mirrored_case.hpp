#pragma once

namespace cases {

struct Case;
class Reading;

/// Adds the image of a plate beyond a symmetry edge that a crack lies on, and notes that; reports what has no image.
void add_images(Case& content, Reading& reading);

}  // namespace cases
