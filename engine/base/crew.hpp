#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace repose {

/// Threads that do the work of one run together: a leader, whose run it is, and helpers. The leader hands out
/// phases, each as many shares as there are members; a phase ends when all shares are done. Helpers may join
/// at any time (a sweep's threads that have nothing else to do) and take part from the leader's next
/// admit() on. What a share does must not depend on which thread does it or how many there are.
///
/// Phases are as short as some microseconds, so members wait for each other by looking, and give their core
/// away only after a while. A share that its helper has not begun when the leader comes by is done by the
/// leader: a helper that the machine has put to sleep delays nobody.
class Crew {
 public:
  static constexpr int kMostMembers = 16;

  /// @param helpers  threads of the crew's own, ≥ 0; at most kMostMembers − 1 are started
  explicit Crew(int helpers = 0);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  // For the leader.

  /// Lets those take part who have joined. Returns the number of members, the leader included.
  int admit();
  [[nodiscard]] int members() const { return members_; }
  /// One phase: work(k) for every share k, 0 ≤ k < members(). Rethrows the first exception of a share, after
  /// all have ended.
  template <class Work>
  void share(Work&& work);
  /// One phase over n things, each done once: work(thing). Member k begins with the k-th part of them, which
  /// its cache may know from the phase before, and goes on to what others have not begun.
  template <class Work>
  void each(std::size_t n, Work&& work);
  /// Sends the helpers away for good.
  void dismiss() { dismissed_.store(true, std::memory_order_release); }
  /// CPU seconds that helpers have worked so far, by a sample of the phases.
  [[nodiscard]] double helped_s() const { return 1e-9 * static_cast<double>(helped_ns_.load()); }

  // For helpers.

  [[nodiscard]] int joined() const { return joined_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool is_full() const { return joined() >= kMostMembers - 1; }

  /// Joins and works until the crew is dismissed. Returns at once where it is, or has no place left.
  void help();

 private:
  using Call = void (*)(void* work, int share);

  void run(void* work, Call call);
  void call_share(int share, std::int64_t begin);
  [[nodiscard]] bool claim(int share, std::uint64_t phase);
  [[nodiscard]] bool wait_for_phase_after(std::uint64_t seen) const;

  /// Written by several threads: one cache line each.
  struct alignas(64) Claimed {
    std::atomic<std::uint64_t> phase{~std::uint64_t{0}};  ///< the last one that somebody took this share of
  };

  int members_ = 1;
  void* work_ = nullptr;
  Call call_ = nullptr;
  alignas(64) std::atomic<std::uint64_t> phase_{0};
  alignas(64) std::atomic<int> left_{0};  ///< shares of this phase that are not done
  std::array<Claimed, kMostMembers> claimed_;
  alignas(64) std::atomic<int> joined_{0};
  std::atomic<bool> dismissed_{false};
  std::atomic<std::int64_t> helped_ns_{0};
  std::mutex fault_mutex_;
  std::exception_ptr fault_;
  std::vector<std::thread> own_;
};

// Work has one piece of machine code, whoever calls it: a copy that the compiler puts into its caller may
// join other products and sums into one rounding, and give other bits to one thread than to two.

template <class Work, class K>
[[gnu::noinline, gnu::noclone]] void call_alike(Work& work, K k) {
  work(k);
}

template <class Work>
void Crew::share(Work&& work) {
  using Plain = std::remove_reference_t<Work>;
  if (members_ == 1) return call_alike<Plain, int>(work, 0);
  run(&work, [](void* at, int share) { call_alike<Plain, int>(*static_cast<Plain*>(at), share); });
}

template <class Work>
void Crew::each(std::size_t n, Work&& work) {
  using Plain = std::remove_reference_t<Work>;
  if (members_ == 1) {
    for (std::size_t thing = 0; thing < n; ++thing) call_alike<Plain, std::size_t>(work, thing);
    return;
  }
  struct alignas(64) Row {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  std::array<Row, kMostMembers> rows;
  const auto members = static_cast<std::size_t>(members_);
  for (std::size_t k = 0; k < members; ++k)
    rows[k].next = n * k / members, rows[k].end = n * (k + 1) / members;
  share([&](int k) {
    for (std::size_t turn = 0; turn < members; ++turn) {
      Row& row = rows[(static_cast<std::size_t>(k) + turn) % members];
      for (std::size_t thing = 0; (thing = row.next.fetch_add(1, std::memory_order_relaxed)) < row.end;)
        call_alike<Plain, std::size_t>(work, thing);
    }
  });
}

}  // namespace repose
