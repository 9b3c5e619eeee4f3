#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace repose {

/// A sphere that some candidate needs, placed in the world; one cache line.
struct alignas(64) PlacedSphere {
  double centre[3] = {};  ///< [m]
  double radius = 0.0;    ///< [m]
  double arm[3] = {};     ///< centre of the sphere − centre of mass of its body [m]
  std::int32_t body = 0;
  std::int32_t sphere = 0;  ///< index in its clump
};

/// A sphere in its body: scaled centre and radius [m].
struct alignas(32) LocalSphere {
  double centre[3] = {};
  double radius = 0.0;
};

/// What a contact remembers (contact/hertz_mindlin.hpp, contact/rolling.hpp).
struct alignas(32) SpringRecord {
  double value[3] = {};
  double root = 0.0;
};
struct alignas(32) RollingRecord {
  double torque[3] = {};
  double unused = 0.0;
};

/// One bit per candidate.
class BitRow {
 public:
  static constexpr std::size_t kWord = 64;

  void clear() { words_.clear(); }
  void push(std::size_t at, bool bit) {
    if (at % kWord == 0) words_.push_back(0);
    if (bit) words_.back() |= one(at);
  }
  [[nodiscard]] bool operator[](std::size_t at) const { return (words_[at / kWord] & one(at)) != 0; }
  void set(std::size_t at, bool bit) {
    if (bit)
      words_[at / kWord] |= one(at);
    else
      words_[at / kWord] &= ~one(at);
  }
  /// Bits first … first + n − 1 become the lowest n of `bits`; n ≤ 32.
  void assign(std::size_t first, std::size_t n, std::uint64_t bits) {
    const std::uint64_t mask = (std::uint64_t{1} << n) - 1;
    const std::size_t word = first / kWord, shift = first % kWord;
    words_[word] = (words_[word] & ~(mask << shift)) | ((bits & mask) << shift);
    if (shift + n <= kWord) return;
    const std::size_t left = kWord - shift;
    words_[word + 1] = (words_[word + 1] & ~(mask >> left)) | ((bits & mask) >> left);
  }
  [[nodiscard]] std::uint64_t word(std::size_t w) const { return words_[w]; }
  [[nodiscard]] std::size_t words() const { return words_.size(); }
  /// Calls visit(number of the bit) for every bit of a word that is set, ascending.
  template <class Visit>
  static void for_each(std::size_t w, std::uint64_t bits, Visit visit) {
    for (; bits != 0; bits &= bits - 1) visit(w * kWord + static_cast<std::size_t>(std::countr_zero(bits)));
  }

 private:
  static std::uint64_t one(std::size_t at) { return std::uint64_t{1} << (at % kWord); }
  std::vector<std::uint64_t> words_;
};

/// Candidates for contact with what they remember, as flat arrays.
struct CandidateArrays {
  std::vector<std::int32_t> a;  ///< placed sphere of body i
  std::vector<std::int32_t> b;  ///< placed sphere of body j; for a wall candidate the wall
  std::vector<SpringRecord> spring;
  std::vector<RollingRecord> rolling;  ///< empty unless the rolling model has a spring
  BitRow touching;                     ///< at the last step; history is zero where it is not set
  BitRow near;                         ///< may touch before its bodies are looked at again (NearList)
  std::size_t count = 0;
  bool rolls = false;  ///< `rolling` is kept

  void clear();
  /// Adds a candidate that remembers what `from` remembers in `old`; from < 0: a new one.
  void push(std::int32_t first, std::int32_t second, const CandidateArrays& old, std::ptrdiff_t from);
  [[nodiscard]] bool touched(std::size_t candidate) const { return touching[candidate]; }
  /// The candidate does not touch any more, and remembers nothing.
  void forget(std::size_t candidate);
};

/// The candidates that may touch before their bodies are looked at again, ascending, ready for the kernels:
/// padded to whole blocks of kBlock with pairs that never touch.
struct NearList {
  static constexpr std::size_t kBlock = 8;
  static constexpr std::int32_t kLine = 8;    ///< doubles of a placed sphere's or body's record
  static constexpr std::int32_t kRecord = 4;  ///< doubles of a candidate's record

  // Offsets of records, in doubles.
  std::vector<std::int32_t> history;             ///< of the candidate's SpringRecord and RollingRecord
  std::vector<std::int32_t> sphere_a, sphere_b;  ///< of PlacedSphere; at a wall b is the wall's number
  std::vector<std::int32_t> body_a, body_b;      ///< of the bodies' records
  std::vector<std::uint8_t> touching;            ///< one bit per candidate of a block, at the last step
  std::size_t count = 0;                         ///< without padding

  [[nodiscard]] std::size_t blocks() const { return touching.size(); }
  [[nodiscard]] std::size_t candidate(std::size_t k) const {
    return static_cast<std::size_t>(history[k] / kRecord);
  }
  /// Takes the candidates whose `near` is set; those that touched and are no longer near forget. The padding
  /// is the dummy of `placed` against itself.
  void gather(CandidateArrays& candidates, const std::vector<PlacedSphere>& placed, bool of_walls);
};

}  // namespace repose
