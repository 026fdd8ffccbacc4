// SPDX-License-Identifier: BSD-3-Clause
#include "solve/progress_bar.h"

#include <exception>
#include <sstream>
#include <utility>

#include "front/system/system.h"

namespace flbc::app {

std::string meshing_stage(double limit) {
  std::ostringstream text;
  text << "meshing the cage (at most " << limit << " s a run)";
  return text.str();
}

ProgressBar::ProgressBar(bool quiet, std::string stage) : text_(std::move(stage)) {
  if (quiet || !is_terminal()) return;
  drawer_ = std::thread([this] {
    try {
      draw_until_ended();
    } catch (const std::exception&) {  // such as out of memory: the work goes on without a bar
    }
  });
}

ProgressBar::~ProgressBar() {
  if (!drawer_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  drawer_.join();
  if (drawn_) write_to_terminal("\r\033[K");
}

void ProgressBar::show(const Progress& progress) {
  if (drawer_.joinable()) replace("solving: iteration " + std::to_string(progress.iteration));
}

void ProgressBar::show(const std::string& stage, double done) {
  if (drawer_.joinable()) replace(stage + " " + std::to_string(static_cast<int>(100 * done)) + "%");
}

void ProgressBar::replace(std::string text) {
  const std::lock_guard lock(mutex_);
  text_ = std::move(text);
}

void ProgressBar::draw_until_ended() {
  constexpr std::chrono::milliseconds kPatience(1000), kInterval(200);
  std::unique_lock lock(mutex_);
  auto pause = kPatience;
  while (!changed_.wait_for(lock, pause, [this] { return ended_; })) {
    const auto time = std::chrono::steady_clock::now() - start_;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time).count();
    write_to_terminal("\r" + text_ + ", " + std::to_string(seconds) + " s\033[K");
    drawn_ = true;
    pause = kInterval;
  }
}

}  // namespace flbc::app
