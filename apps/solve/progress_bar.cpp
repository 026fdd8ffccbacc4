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

ProgressBar::ProgressBar(bool quiet, std::string stage, const SolverOptions& options)
    : stage_(std::move(stage)), estimate_(options) {
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
  if (!drawer_.joinable()) return;
  const std::lock_guard lock(mutex_);
  estimate_.update(progress, std::chrono::duration<double>(Clock::now() - start_).count());
}

void ProgressBar::show(const std::string& stage, double done) {
  if (!drawer_.joinable()) return;
  const std::lock_guard lock(mutex_);
  estimate_.update_stage(stage, done, std::chrono::duration<double>(Clock::now() - start_).count());
}

void ProgressBar::draw_until_ended() {
  constexpr std::chrono::milliseconds kPatience(1000), kInterval(200);
  std::unique_lock lock(mutex_);
  auto pause = kPatience;
  while (!changed_.wait_for(lock, pause, [this] { return ended_; })) {
    draw();
    pause = kInterval;
  }
}

void ProgressBar::draw() {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  write_to_terminal("\r" + estimate_.line(stage_, seconds) + "\033[K");
  drawn_ = true;
}

}  // namespace flbc::app
