#pragma once

#include <cmath>
#include <cstddef>
#include <experimental/simd>
#include <vector>
#ifdef __AVX__
#include <immintrin.h>
#endif

/// The laws are small pieces of one kernel; a call between them would pass whole vector registers through
/// memory.
#define REPOSE_INLINE [[gnu::always_inline]] inline

namespace repose {

namespace stdx = std::experimental;

/// As many doubles as one vector register of the machine holds.
using SimdReal = stdx::native_simd<double>;

/// The contact laws are written once for T = double (one contact) and T = SimdReal (a block of contacts).
/// What differs between the two is here. Lanes never mix, so a contact's result does not depend on its lane
/// or its neighbours.
REPOSE_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
template <class T>
REPOSE_INLINE T select(const typename T::mask_type& condition, const T& yes, const T& no) {
  T result = no;
  stdx::where(condition, result) = yes;
  return result;
}

template <class T>
REPOSE_INLINE T square_root(const T& x) {
  using std::sqrt;
  return sqrt(x);
}
template <class T>
REPOSE_INLINE T absolute(const T& x) {
  using std::abs;
  return abs(x);
}
template <class T>
REPOSE_INLINE T smaller(const T& a, const T& b) {
  return select(a < b, a, b);
}
template <class T>
REPOSE_INLINE T larger(const T& a, const T& b) {
  return select(a > b, a, b);
}

inline constexpr std::size_t kSimdWidth = SimdReal::size();

/// Whether several divisions are one, by the product of their denominators. A division of doubles takes as
/// long as some twenty multiplications; one of floats is cheap, and the product may be too small for them.
template <class T>
inline constexpr bool kSharesDivisions = true;

/// What is smaller counts as nothing to divide by: forces, displacements and their squares, spins.
template <class T>
inline constexpr double kNothing = 1e-60;

/// Two vectors that go the same way side by side. A law is one long chain of roots and divisions, during
/// which a core has nothing else to do; with a second chain beside it, it has. Measured in
/// tools/bench/NOTES.md.
struct Twin {
  struct mask_type {
    SimdReal::mask_type one, two;
  };
  SimdReal one, two;

  Twin() = default;
  REPOSE_INLINE Twin(double x) : one(x), two(x) {}
  REPOSE_INLINE Twin(const SimdReal& first, const SimdReal& second) : one(first), two(second) {}
  template <int kHalf>
  REPOSE_INLINE const SimdReal& half() const {
    if constexpr (kHalf == 0)
      return one;
    else
      return two;
  }

  REPOSE_INLINE friend Twin operator+(const Twin& a, const Twin& b) { return {a.one + b.one, a.two + b.two}; }
  REPOSE_INLINE friend Twin operator-(const Twin& a, const Twin& b) { return {a.one - b.one, a.two - b.two}; }
  REPOSE_INLINE friend Twin operator*(const Twin& a, const Twin& b) { return {a.one * b.one, a.two * b.two}; }
  REPOSE_INLINE friend Twin operator/(const Twin& a, const Twin& b) { return {a.one / b.one, a.two / b.two}; }
  REPOSE_INLINE friend Twin operator-(const Twin& a) { return {-a.one, -a.two}; }
  REPOSE_INLINE friend mask_type operator<(const Twin& a, const Twin& b) {
    return {a.one < b.one, a.two < b.two};
  }
  REPOSE_INLINE friend mask_type operator>(const Twin& a, const Twin& b) {
    return {a.one > b.one, a.two > b.two};
  }
};
REPOSE_INLINE Twin select(const Twin::mask_type& condition, const Twin& yes, const Twin& no) {
  return {select<SimdReal>(condition.one, yes.one, no.one), select<SimdReal>(condition.two, yes.two, no.two)};
}
REPOSE_INLINE Twin square_root(const Twin& x) { return {stdx::sqrt(x.one), stdx::sqrt(x.two)}; }
REPOSE_INLINE Twin absolute(const Twin& x) { return {stdx::abs(x.one), stdx::abs(x.two)}; }

/// kSimdWidth values of an array from `first` on; their number is a multiple of kSimdWidth.
REPOSE_INLINE SimdReal load(const std::vector<double>& array, std::size_t first) {
  return SimdReal(array.data() + first, stdx::element_aligned);
}
REPOSE_INLINE void store(const SimdReal& value, std::vector<double>& array, std::size_t first) {
  value.copy_to(array.data() + first, stdx::element_aligned);
}

/// Bit l is a < b in lane l.
REPOSE_INLINE unsigned less_bits(const SimdReal& a, const SimdReal& b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask(static_cast<__m512d>(a), static_cast<__m512d>(b), _CMP_LT_OQ);
#elif defined(__AVX__)
  return static_cast<unsigned>(
      _mm256_movemask_pd(_mm256_cmp_pd(static_cast<__m256d>(a), static_cast<__m256d>(b), _CMP_LT_OQ)));
#else
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    bits |= static_cast<unsigned>(a[lane] < b[lane]) << lane;
  return bits;
#endif
}

/// A vector of three T: world x, y, z. (Eigen's fixed vectors do not take SIMD scalars.)
template <class T>
struct Triple {
  T x, y, z;

  REPOSE_INLINE friend Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  REPOSE_INLINE friend Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  REPOSE_INLINE friend Triple operator*(const T& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  REPOSE_INLINE friend T dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  REPOSE_INLINE friend Triple cross(const Triple& a, const Triple& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  REPOSE_INLINE friend T length(const Triple& a) { return square_root(dot(a, a)); }
};

REPOSE_INLINE Triple<Twin> twin(const Triple<SimdReal>& one, const Triple<SimdReal>& two) {
  return {{one.x, two.x}, {one.y, two.y}, {one.z, two.z}};
}
template <int kHalf>
REPOSE_INLINE Triple<SimdReal> half_of(const Triple<Twin>& t) {
  return {t.x.half<kHalf>(), t.y.half<kHalf>(), t.z.half<kHalf>()};
}

template <class M, class T>
REPOSE_INLINE Triple<T> select3(const M& condition, const Triple<T>& yes, const Triple<T>& no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y), select(condition, yes.z, no.z)};
}

}  // namespace repose
