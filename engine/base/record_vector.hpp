#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace repose {

/// Memory for arrays that are read at random: from kLarge on in pages of 2 MiB, as far as the system gives
/// them. With pages of 4 KiB a core knows the addresses of some 8 MB, and looks every other one up in memory.
template <class T>
struct RecordAllocator {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{2} << 20, kLarge = kPage / 2;  ///< [bytes]

  RecordAllocator() = default;
  template <class Other>
  RecordAllocator(const RecordAllocator<Other>&) noexcept {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > kMost / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = n * sizeof(T);
    if (bytes < kLarge) return static_cast<T*>(::operator new(bytes, kAlignment));
    void* memory = ::operator new (whole_pages(bytes), std::align_val_t{kPage});
    madvise(memory, whole_pages(bytes), MADV_HUGEPAGE);  // a wish: without it all works as well
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    if (n * sizeof(T) < kLarge)
      ::operator delete(memory, kAlignment);
    else
      ::operator delete (memory, std::align_val_t{kPage});
  }

  friend bool operator==(const RecordAllocator&, const RecordAllocator&) { return true; }

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 60;  ///< [bytes]
  static constexpr std::align_val_t kAlignment{alignof(T)};
  static constexpr std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }
};

template <class T>
using RecordVector = std::vector<T, RecordAllocator<T>>;

}  // namespace repose
