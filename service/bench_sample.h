// Times of one contender, frame by frame and repeat by repeat, and what is said of them.
//
// Noise of the machine only ever adds. So for each frame the least over the repeats counts, and the median and extremes
// over the frames are taken of those; `median_all` is the median of everything measured, noise included.
#pragma once

#include <cstddef>
#include <vector>

namespace gridcull {

class TimeSamples {
 public:
  /// Microseconds of one frame in one repeat.
  void add(std::size_t frame, double microseconds);
  bool empty() const { return least_.empty(); }
  std::size_t frames() const { return least_.size(); }

  /// Frames from `first` on; zeros where there are none.
  struct Summary {
    double min = 0.0;         ///< the quickest frame
    double median = 0.0;      ///< over frames of the least over repeats
    double max = 0.0;         ///< the slowest frame, by its least
    double median_all = 0.0;  ///< over all frames and repeats
  };
  Summary summary(std::size_t first) const;
  /// Without the first frame, in which everything is built, unless there is no other.
  Summary steady() const { return summary(frames() > 1 ? 1 : 0); }
  /// The least of one frame.
  double least(std::size_t frame) const { return least_.at(frame); }

 private:
  std::vector<double> least_{};
  std::vector<std::vector<double>> all_{};  ///< by frame
};

/// Of an even number: the mean of the middle two. 0 of none.
double median_of(std::vector<double> values);

}  // namespace gridcull
