#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/contact/simd.hpp"
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace repose {

/// Records of a few doubles in memory as vectors of one field each, and back: lane l of field f is record l's
/// field f. Reading whole records and transposing them in registers takes 32 instructions for eight records
/// of eight doubles; gathering field by field takes 8 gathers of about 26 micro-operations each, which
/// was 1.3 times slower over a whole run. The paths for AVX-512 and AVX are written out; elsewhere the
/// vectors are built lane by lane, with the same result.
using LaneOffsets = std::array<std::int32_t, kSimdWidth>;  ///< of each lane's record, in doubles
using Fields8 = std::array<SimdReal, 8>;
using Fields4 = std::array<SimdReal, 4>;

/// Which of eight numbers are kept: those whose bit is set, at the front. Eight may be written.
class KeptLanes {
 public:
#ifdef __AVX2__
  REPOSE_INLINE explicit KeptLanes(unsigned bits) : order_(order_of(bits)) {}

  REPOSE_INLINE void copy(const std::int32_t* from, std::int32_t* to) const {
    keep(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)), to);
  }
  /// Keeps of factor × first, factor × (first + 1), …
  REPOSE_INLINE void copy_multiples(std::int32_t factor, std::int32_t first, std::int32_t* to) const {
    const __m256i lane = _mm256_add_epi32(order_, _mm256_set1_epi32(first));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_mullo_epi32(lane, _mm256_set1_epi32(factor)));
  }

 private:
  /// Byte k: the k-th lane that is kept.
  static constexpr std::array<std::uint64_t, 256> kOrders = [] {
    std::array<std::uint64_t, 256> orders{};
    for (unsigned bits = 0; bits < 256; ++bits) {
      int shift = 0;
      for (unsigned lane = 0; lane < 8; ++lane)
        if ((bits >> lane & 1U) != 0) orders[bits] |= std::uint64_t{lane} << shift, shift += 8;
    }
    return orders;
  }();
  REPOSE_INLINE static __m256i order_of(unsigned bits) {
    return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kOrders[bits])));
  }
  REPOSE_INLINE void keep(const __m256i& all, std::int32_t* to) const {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(all, order_));
  }

  __m256i order_;
#else
  explicit KeptLanes(unsigned bits) : bits_(bits) {}

  void copy(const std::int32_t* from, std::int32_t* to) const {
    for (unsigned left = bits_; left != 0; left &= left - 1) *to++ = from[std::countr_zero(left)];
  }
  void copy_multiples(std::int32_t factor, std::int32_t first, std::int32_t* to) const {
    for (unsigned left = bits_; left != 0; left &= left - 1)
      *to++ = factor * (first + std::countr_zero(left));
  }

 private:
  unsigned bits_;
#endif
};

#ifdef __AVX512F__

struct Rows {
  __m512d r[8];
  __m512d& operator[](std::size_t k) { return r[k]; }
  const __m512d& operator[](std::size_t k) const { return r[k]; }
};

/// Transposes an 8 × 8 block: 8 pair-wise interleaves, then two rounds that move quarters.
REPOSE_INLINE void transpose8(Rows& r) {
  for (std::size_t k = 0; k < 8; k += 2) {
    const __m512d low = _mm512_unpacklo_pd(r[k], r[k + 1]), high = _mm512_unpackhi_pd(r[k], r[k + 1]);
    r[k] = low, r[k + 1] = high;
  }
  const auto even = [](__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0x88); };
  const auto odd = [](__m512d a, __m512d b) { return _mm512_shuffle_f64x2(a, b, 0xdd); };
  for (std::size_t k = 0; k < 2; ++k) {
    const __m512d a = even(r[k], r[k + 2]), b = odd(r[k], r[k + 2]), c = even(r[k + 4], r[k + 6]),
                  d = odd(r[k + 4], r[k + 6]);
    r[k] = even(a, c), r[k + 4] = odd(a, c), r[k + 2] = even(b, d), r[k + 6] = odd(b, d);
  }
}

REPOSE_INLINE Fields8 load_fields8(const double* base, const std::int32_t* offset) {
  Rows rows;
  for (std::size_t lane = 0; lane < 8; ++lane) rows[lane] = _mm512_load_pd(base + offset[lane]);
  transpose8(rows);
  Fields8 fields;
  for (std::size_t f = 0; f < 8; ++f) fields[f] = static_cast<SimdReal>(rows[f]);
  return fields;
}

REPOSE_INLINE Rows rows_of(const Fields8& fields) {
  Rows rows;
  for (std::size_t f = 0; f < 8; ++f) rows[f] = static_cast<__m512d>(fields[f]);
  transpose8(rows);
  return rows;
}

REPOSE_INLINE void store_fields8(const Fields8& fields, double* base, const std::int32_t* offset) {
  const Rows rows = rows_of(fields);
  for (std::size_t lane = 0; lane < 8; ++lane) _mm512_store_pd(base + offset[lane], rows[lane]);
}

/// Records a and then b of each of the first `lanes` lanes are increased, lane after lane: two lanes may
/// share a record.
REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at_a, const Fields8& b,
                               const std::int32_t* at_b, double* base, std::size_t lanes) {
  const Rows rows_a = rows_of(a), rows_b = rows_of(b);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    _mm512_store_pd(base + at_a[lane], _mm512_add_pd(_mm512_load_pd(base + at_a[lane]), rows_a[lane]));
    _mm512_store_pd(base + at_b[lane], _mm512_add_pd(_mm512_load_pd(base + at_b[lane]), rows_b[lane]));
  }
}

REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at, double* base, std::size_t lanes) {
  const Rows rows = rows_of(a);
  for (std::size_t lane = 0; lane < lanes; ++lane)
    _mm512_store_pd(base + at[lane], _mm512_add_pd(_mm512_load_pd(base + at[lane]), rows[lane]));
}

/// The first four doubles of each record.
REPOSE_INLINE Fields4 load_fields4(const double* base, const std::int32_t* offset) {
  const auto two = [&](std::size_t low, std::size_t high) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(base + offset[low])),
                              _mm256_load_pd(base + offset[high]), 1);
  };
  const __m512d r0 = two(0, 2), r1 = two(1, 3), r2 = two(4, 6), r3 = two(5, 7);
  const __m512d a = _mm512_unpacklo_pd(r0, r1), b = _mm512_unpackhi_pd(r0, r1);
  const __m512d c = _mm512_unpacklo_pd(r2, r3), d = _mm512_unpackhi_pd(r2, r3);
  return {static_cast<SimdReal>(_mm512_shuffle_f64x2(a, c, 0x88)),
          static_cast<SimdReal>(_mm512_shuffle_f64x2(b, d, 0x88)),
          static_cast<SimdReal>(_mm512_shuffle_f64x2(a, c, 0xdd)),
          static_cast<SimdReal>(_mm512_shuffle_f64x2(b, d, 0xdd))};
}

/// Stores the first four doubles of the records of the first `lanes` lanes.
REPOSE_INLINE void store_fields4(const Fields4& f, double* base, const std::int32_t* offset,
                                 std::size_t lanes) {
  const auto m = [&](std::size_t k) { return static_cast<__m512d>(f[k]); };
  const __m512d a = _mm512_unpacklo_pd(m(0), m(1)), b = _mm512_unpackhi_pd(m(0), m(1));
  const __m512d c = _mm512_unpacklo_pd(m(2), m(3)), d = _mm512_unpackhi_pd(m(2), m(3));
  // 128-bit quarters: a, c hold lanes 0 2 4 6, b, d lanes 1 3 5 7
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                last = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  const __m512d lanes02 = _mm512_permutex2var_pd(a, first, c), lanes46 = _mm512_permutex2var_pd(a, last, c);
  const __m512d lanes13 = _mm512_permutex2var_pd(b, first, d), lanes57 = _mm512_permutex2var_pd(b, last, d);
  const __m256d rows[8] = {_mm512_castpd512_pd256(lanes02),    _mm512_castpd512_pd256(lanes13),
                           _mm512_extractf64x4_pd(lanes02, 1), _mm512_extractf64x4_pd(lanes13, 1),
                           _mm512_castpd512_pd256(lanes46),    _mm512_castpd512_pd256(lanes57),
                           _mm512_extractf64x4_pd(lanes46, 1), _mm512_extractf64x4_pd(lanes57, 1)};
  for (std::size_t lane = 0; lane < lanes; ++lane) _mm256_store_pd(base + offset[lane], rows[lane]);
}

#elif defined(__AVX__)

/// Transposes a 4 × 4 block: two interleaves, then one exchange of halves.
REPOSE_INLINE void transpose4(__m256d r[4]) {
  const __m256d a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
  r[0] = _mm256_permute2f128_pd(a, c, 0x20), r[1] = _mm256_permute2f128_pd(b, d, 0x20);
  r[2] = _mm256_permute2f128_pd(a, c, 0x31), r[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

/// Four neighbouring fields of each record, from `base` on.
REPOSE_INLINE Fields4 load_fields4(const double* base, const std::int32_t* offset) {
  __m256d rows[4];
  for (std::size_t lane = 0; lane < 4; ++lane) rows[lane] = _mm256_load_pd(base + offset[lane]);
  transpose4(rows);
  return {static_cast<SimdReal>(rows[0]), static_cast<SimdReal>(rows[1]), static_cast<SimdReal>(rows[2]),
          static_cast<SimdReal>(rows[3])};
}

REPOSE_INLINE Fields8 load_fields8(const double* base, const std::int32_t* offset) {
  const Fields4 low = load_fields4(base, offset), high = load_fields4(base + 4, offset);
  return {low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]};
}

/// Row l holds four fields of lane l.
struct Rows {
  __m256d r[4];
};

REPOSE_INLINE Rows rows_of(const SimdReal* fields) {
  Rows rows;
  for (std::size_t f = 0; f < 4; ++f) rows.r[f] = static_cast<__m256d>(fields[f]);
  transpose4(rows.r);
  return rows;
}

/// Stores the first four doubles of the records of the first `lanes` lanes.
REPOSE_INLINE void store_fields4(const Fields4& fields, double* base, const std::int32_t* offset,
                                 std::size_t lanes) {
  const Rows rows = rows_of(fields.data());
  for (std::size_t lane = 0; lane < lanes; ++lane) _mm256_store_pd(base + offset[lane], rows.r[lane]);
}

REPOSE_INLINE void store_fields8(const Fields8& fields, double* base, const std::int32_t* offset) {
  const Rows low = rows_of(fields.data()), high = rows_of(fields.data() + 4);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    _mm256_store_pd(base + offset[lane], low.r[lane]);
    _mm256_store_pd(base + offset[lane] + 4, high.r[lane]);
  }
}

REPOSE_INLINE void add_row(double* record, const __m256d& row) {
  _mm256_store_pd(record, _mm256_add_pd(_mm256_load_pd(record), row));
}

/// Records a and then b of each of the first `lanes` lanes are increased, lane after lane: two lanes may
/// share a record.
REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at_a, const Fields8& b,
                               const std::int32_t* at_b, double* base, std::size_t lanes) {
  const Rows low_a = rows_of(a.data()), high_a = rows_of(a.data() + 4);
  const Rows low_b = rows_of(b.data()), high_b = rows_of(b.data() + 4);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    add_row(base + at_a[lane], low_a.r[lane]), add_row(base + at_a[lane] + 4, high_a.r[lane]);
    add_row(base + at_b[lane], low_b.r[lane]), add_row(base + at_b[lane] + 4, high_b.r[lane]);
  }
}

REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at, double* base, std::size_t lanes) {
  const Rows low = rows_of(a.data()), high = rows_of(a.data() + 4);
  for (std::size_t lane = 0; lane < lanes; ++lane)
    add_row(base + at[lane], low.r[lane]), add_row(base + at[lane] + 4, high.r[lane]);
}

#else

template <std::size_t N>
REPOSE_INLINE std::array<SimdReal, N> load_fields(const double* base, const std::int32_t* offset) {
  std::array<SimdReal, N> fields;
  for (std::size_t f = 0; f < N; ++f)
    fields[f] = SimdReal([&](auto lane) { return base[static_cast<std::size_t>(offset[lane]) + f]; });
  return fields;
}
template <std::size_t N>
REPOSE_INLINE void store_fields(const std::array<SimdReal, N>& fields, double* base,
                                const std::int32_t* offset, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    for (std::size_t f = 0; f < N; ++f) base[static_cast<std::size_t>(offset[lane]) + f] = fields[f][lane];
}

REPOSE_INLINE Fields8 load_fields8(const double* base, const std::int32_t* offset) {
  return load_fields<8>(base, offset);
}
REPOSE_INLINE Fields4 load_fields4(const double* base, const std::int32_t* offset) {
  return load_fields<4>(base, offset);
}
REPOSE_INLINE void store_fields8(const Fields8& fields, double* base, const std::int32_t* offset) {
  store_fields(fields, base, offset, kSimdWidth);
}
REPOSE_INLINE void store_fields4(const Fields4& fields, double* base, const std::int32_t* offset,
                                 std::size_t lanes) {
  store_fields(fields, base, offset, lanes);
}
/// Records a and then b of each of the first `lanes` lanes are increased, lane after lane: two lanes may
/// share a record.
REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at_a, const Fields8& b,
                               const std::int32_t* at_b, double* base, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (std::size_t f = 0; f < 8; ++f) base[static_cast<std::size_t>(at_a[lane]) + f] += a[f][lane];
    for (std::size_t f = 0; f < 8; ++f) base[static_cast<std::size_t>(at_b[lane]) + f] += b[f][lane];
  }
}
REPOSE_INLINE void add_fields8(const Fields8& a, const std::int32_t* at, double* base, std::size_t lanes) {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    for (std::size_t f = 0; f < 8; ++f) base[static_cast<std::size_t>(at[lane]) + f] += a[f][lane];
}

#endif

}  // namespace repose
