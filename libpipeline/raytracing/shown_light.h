#pragma once

#include <algorithm>
#include <optional>

namespace pipeline {

/// What rays have seen, for the note on a picture that shows nothing.
struct ShownLight {
  bool has_seen = false;         // a surface
  bool shows_something = false;  // a color other than the background's, by more than one step in a channel
  bool has_facing_light = false;
  bool has_arriving_light = false;  // some part of a light that faces a surface
  bool is_cut = false;              // a ray
  /// Of the surfaces whose own color counts; none if mirrors and glass alone are seen.
  std::optional<double> greatest_channel;

  void add(const ShownLight& other) {
    has_seen |= other.has_seen;
    shows_something |= other.shows_something;
    has_facing_light |= other.has_facing_light;
    has_arriving_light |= other.has_arriving_light;
    is_cut |= other.is_cut;
    greatest_channel = std::max(greatest_channel, other.greatest_channel);  // none is the least
  }
};

}  // namespace pipeline
