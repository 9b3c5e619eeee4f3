#pragma once

#include "engine/contact/simd.hpp"
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace repose {

/// As many floats as one vector register of the machine holds, those of two SimdReal: a contact law in single
/// precision, that takes its numbers from doubles and gives its results to doubles (numerics.arithmetic
/// "mixed"). Rounding is to 6e-8 of a number. Numbers below 1e-38 are lost, so that products of many small
/// ones are not to be formed: see kSharesDivisions and kNothing.
struct Single {
  using Vector = stdx::native_simd<float>;
  using mask_type = Vector::mask_type;
  static_assert(Vector::size() == 2 * kSimdWidth);

  Vector v;

  Single() = default;
  REPOSE_INLINE Single(double x) : v(static_cast<float>(x)) {}
  REPOSE_INLINE explicit Single(const Vector& x) : v(x) {}
  REPOSE_INLINE Single(const SimdReal& first, const SimdReal& second) : v(joined(first, second)) {}
  REPOSE_INLINE explicit Single(const Twin& wide) : Single(wide.one, wide.two) {}

  template <int kHalf>
  [[nodiscard]] REPOSE_INLINE SimdReal half() const {
#if defined(__AVX512F__)
    return static_cast<SimdReal>(_mm512_cvtps_pd(
        _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(static_cast<__m512>(v)), kHalf))));
#elif defined(__AVX__)
    return static_cast<SimdReal>(_mm256_cvtps_pd(_mm256_extractf128_ps(static_cast<__m256>(v), kHalf)));
#else
    return SimdReal([&](auto lane) { return static_cast<double>(v[lane + kHalf * kSimdWidth]); });
#endif
  }

  REPOSE_INLINE friend Single operator+(const Single& a, const Single& b) { return Single(a.v + b.v); }
  REPOSE_INLINE friend Single operator-(const Single& a, const Single& b) { return Single(a.v - b.v); }
  REPOSE_INLINE friend Single operator*(const Single& a, const Single& b) { return Single(a.v * b.v); }
  REPOSE_INLINE friend Single operator/(const Single& a, const Single& b) { return Single(a.v / b.v); }
  REPOSE_INLINE friend Single operator-(const Single& a) { return Single(-a.v); }
  REPOSE_INLINE friend mask_type operator<(const Single& a, const Single& b) { return a.v < b.v; }
  REPOSE_INLINE friend mask_type operator>(const Single& a, const Single& b) { return a.v > b.v; }

 private:
  REPOSE_INLINE static Vector joined(const SimdReal& first, const SimdReal& second) {
#if defined(__AVX512F__)
    const __m512d low =
        _mm512_castpd256_pd512(_mm256_castps_pd(_mm512_cvtpd_ps(static_cast<__m512d>(first))));
    const __m256d high = _mm256_castps_pd(_mm512_cvtpd_ps(static_cast<__m512d>(second)));
    return static_cast<Vector>(_mm512_castpd_ps(_mm512_insertf64x4(low, high, 1)));
#elif defined(__AVX__)
    return static_cast<Vector>(_mm256_set_m128(_mm256_cvtpd_ps(static_cast<__m256d>(second)),
                                               _mm256_cvtpd_ps(static_cast<__m256d>(first))));
#else
    return Vector([&](auto lane) {
      return static_cast<float>(lane < kSimdWidth ? first[lane] : second[lane - kSimdWidth]);
    });
#endif
  }
};

REPOSE_INLINE Single select(const Single::mask_type& condition, const Single& yes, const Single& no) {
  Single result = no;
  stdx::where(condition, result.v) = yes.v;
  return result;
}
REPOSE_INLINE Single square_root(const Single& x) { return Single(stdx::sqrt(x.v)); }
REPOSE_INLINE Single absolute(const Single& x) { return Single(stdx::abs(x.v)); }

template <>
inline constexpr bool kSharesDivisions<Single> = false;
template <>
inline constexpr double kNothing<Single> = 1e-36;

}  // namespace repose
