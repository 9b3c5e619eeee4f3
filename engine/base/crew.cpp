#include "engine/base/crew.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

namespace repose {

namespace {

/// Looks again and again for some ten microseconds, longer than the leader takes between two phases; then
/// lets others have the core between looks, and at last sleeps: the leader is packing or writing.
class Patience {
 public:
  void wait() {
    if (++looks_ > kYields) return std::this_thread::sleep_for(std::chrono::microseconds(50));
    if (looks_ > kLooks) return std::this_thread::yield();
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
  }

 private:
  static constexpr int kLooks = 2000, kYields = 4000;
  int looks_ = 0;
};

/// A clock that costs a system call: one phase in so many is timed for all. Phases come in threes, which this
/// is no multiple of.
constexpr std::int64_t kPhasesATime = 16, kUntimed = -1;
std::int64_t thread_cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1000000000 * std::int64_t{now.tv_sec} + now.tv_nsec;
}

}  // namespace

Crew::Crew(int helpers) {
  for (int k = 0; k < std::min(helpers, kMostMembers - 1); ++k) own_.emplace_back([this] { help(); });
}

Crew::~Crew() {
  dismiss();
  for (std::thread& helper : own_) helper.join();
}

int Crew::admit() {
  const int members = 1 + std::min(joined_.load(std::memory_order_acquire), kMostMembers - 1);
  for (; members_ < members; ++members_)
    claimed_[static_cast<std::size_t>(members_)].phase.store(phase_.load(std::memory_order_relaxed));
  return members_;
}

/// Share k of a phase belongs to whoever moves claimed_[k] on to it; nobody can take one of a phase that is
/// over, because all its shares have been taken.
bool Crew::claim(int share, std::uint64_t phase) {
  std::uint64_t before = phase - 1;
  return claimed_[static_cast<std::size_t>(share)].phase.compare_exchange_strong(before, phase,
                                                                                 std::memory_order_acq_rel);
}

void Crew::run(void* work, Call call) {
  work_ = work, call_ = call;
  const std::uint64_t phase = phase_.load(std::memory_order_relaxed) + 1;
  claimed_[0].phase.store(phase - 1, std::memory_order_relaxed);
  left_.store(members_, std::memory_order_relaxed);
  phase_.store(phase, std::memory_order_release);
  for (int k = 0; k < members_; ++k)
    if (claim(k, phase)) call_share(k, kUntimed);
  for (Patience patience; left_.load(std::memory_order_acquire) != 0;) patience.wait();
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
}

void Crew::call_share(int share, std::int64_t begin) {
  try {
    call_(work_, share);
  } catch (...) {
    const std::lock_guard lock(fault_mutex_);
    if (!fault_) fault_ = std::current_exception();
  }
  if (begin != kUntimed)
    helped_ns_.fetch_add(kPhasesATime * (thread_cpu_ns() - begin), std::memory_order_relaxed);
  left_.fetch_sub(1, std::memory_order_acq_rel);
}

bool Crew::wait_for_phase_after(std::uint64_t seen) const {
  for (Patience patience; phase_.load(std::memory_order_acquire) == seen;) {
    if (dismissed_.load(std::memory_order_acquire)) return false;
    patience.wait();
  }
  return true;
}

void Crew::help() {
  if (dismissed_.load(std::memory_order_acquire)) return;
  const int seat = 1 + joined_.fetch_add(1, std::memory_order_acq_rel);
  if (seat >= kMostMembers) return;
  std::uint64_t seen = phase_.load(std::memory_order_acquire);
  while (wait_for_phase_after(seen)) {
    seen = phase_.load(std::memory_order_acquire);
    if (claim(seat, seen)) call_share(seat, seen % kPhasesATime == 0 ? thread_cpu_ns() : kUntimed);
  }
}

}  // namespace repose
