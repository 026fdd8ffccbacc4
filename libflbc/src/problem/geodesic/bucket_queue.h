// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The queue of the fast marching method.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "flbc/types.h"

namespace flbc::distance {

//! A queue of vertices that is sorted by buckets of distances; the last one pushed into a bucket
//! leaves it first.
class BucketQueue {
 public:
  //! \param width  of the buckets
  explicit BucketQueue(float width) : per_distance_(1 / width) {}

  void push(Index vertex, float distance) {
    const auto bucket = std::max(current_, static_cast<int>(distance * per_distance_));
    if (static_cast<std::size_t>(bucket) >= top_.size()) {
      top_.resize(static_cast<std::size_t>(bucket) * 2 + 1, kEmpty);
    }
    entries_.push_back({vertex, top_[bucket]});
    top_[bucket] = static_cast<int>(entries_.size()) - 1;
  }

  //! \return -1 if it is empty
  Index pop() {
    for (; static_cast<std::size_t>(current_) < top_.size(); ++current_) {
      const int top = top_[current_];
      if (top == kEmpty) continue;
      top_[current_] = entries_[top].below;
      return entries_[top].vertex;
    }
    return -1;
  }

  //! The vertex that leaves next unless another is pushed, or -1 if that has not been looked up.
  //! Only after a vertex has left.
  Index next() const {
    const int top = top_[current_];
    return top == kEmpty ? -1 : entries_[top].vertex;
  }

  //! For another source.
  void restart() {
    std::fill(top_.begin(), top_.end(), kEmpty);
    current_ = 0;
    entries_.clear();
  }

 private:
  static constexpr int kEmpty = -1;
  struct Entry {
    Index vertex;
    int below;  // the entry below it in its bucket
  };

  float per_distance_;
  int current_ = 0;
  std::vector<int> top_;        // of each bucket
  std::vector<Entry> entries_;  // all since the start
};

}  // namespace flbc::distance
