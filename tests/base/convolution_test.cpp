// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/convolution.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/parallel.hpp>

#include "base/memory.hpp"

using namespace salebra;

namespace {

struct Case {
  Index nx, ny, period_x, period_y;
};

// Kernels with an exactly known transform: sums of a few cosines or sines.
double even_symbol(Index i, Index j, Index px, Index py) {
  return 3 +
         std::cos(2 * M_PI * double(i) / double(px)) * std::cos(4 * M_PI * double(j) / double(py));
}
double odd_symbol(Index i, Index j, Index px, Index py) {
  return -std::sin(2 * M_PI * double(i) / double(px)) * std::sin(2 * M_PI * double(j) / double(py));
}

// 1/i of the transform of a kernel that is odd along one axis and even along the other.
double odd_along_one_symbol(Index i, Index j, Index px, Index py) {
  return -std::sin(2 * M_PI * double(i) / double(px)) * std::cos(2 * M_PI * double(j) / double(py));
}

// Applies the kernels of these symbols point by point: 3δ + ¼ Σ δ(a±1, b±2) and ¼ Σ ±δ(a±1, b±1).
double circular(const Field& field, const Case& shape, Index a, Index b) {
  const Index i = (a % shape.period_x + shape.period_x) % shape.period_x;
  const Index j = (b % shape.period_y + shape.period_y) % shape.period_y;
  return i < shape.nx && j < shape.ny ? field(i, j) : 0;
}
double by_hand_even(const Field& field, const Case& shape, Index a, Index b) {
  double sum = 3 * field(a, b);
  for (const int x : {-1, 1})
    for (const int y : {-2, 2}) sum += 0.25 * circular(field, shape, a + x, b + y);
  return sum;
}
double by_hand_odd(const Field& field, const Case& shape, Index a, Index b) {
  double sum = 0;
  for (const int x : {-1, 1})
    for (const int y : {-1, 1}) sum += 0.25 * x * y * circular(field, shape, a - x, b - y);
  return sum;
}

double by_hand_odd_along_one(const Field& field, const Case& shape, Index a, Index b,
                             bool along_x) {
  double sum = 0;
  for (const int x : {-1, 1})
    for (const int y : {-1, 1})
      sum += 0.25 * (along_x ? x : y) * circular(field, shape, a - x, b - y);
  return sum;
}

}  // namespace

TEST_CASE("A convolution equals the sum over the kernel's points, circular and zero-padded",
          "[convolution]") {
  // Rows are paired within blocks of 16. Cases: full blocks, a last block of 1, 7, 8 and 15 rows,
  // and a single block that is not full.
  const Case shape =
      GENERATE(Case{16, 64, 16, 64}, Case{7, 45, 7, 45}, Case{1, 5, 1, 5}, Case{33, 20, 66, 40},
               Case{5, 6, 12, 15}, Case{23, 12, 23, 12}, Case{40, 9, 40, 9}, Case{47, 8, 94, 16});
  const Field field = Field::Random(shape.nx, shape.ny), second = Field::Random(shape.nx, shape.ny);
  const auto even = [&](Index i, Index j) {
    return even_symbol(i, j, shape.period_x, shape.period_y);
  };
  const auto odd = [&](Index i, Index j) {
    return odd_symbol(i, j, shape.period_x, shape.period_y);
  };
  const Convolution2D<double>::Shape periods{shape.nx, shape.ny, shape.period_x, shape.period_y};
  Convolution2D<double> scalar(periods);
  scalar.set_symbol(0, 0, even);
  Field result(shape.nx, shape.ny);
  scalar.apply(field.data(), result.data());

  Convolution2D<double> vector(periods, 2);
  vector.set_symbol(0, 0, even);
  vector.set_symbol(0, 1, odd, Parity::odd);
  Field x(shape.nx, shape.ny), y(shape.nx, shape.ny);
  vector.apply({field.data(), second.data()}, {x.data(), y.data()});

  Convolution2D<double> gradient(periods, 2);
  gradient.set_symbol(
      0, 0,
      [&](Index i, Index j) { return odd_along_one_symbol(i, j, shape.period_x, shape.period_y); },
      Parity::odd_along_x);
  gradient.set_symbol(
      0, 1,
      [&](Index i, Index j) { return odd_along_one_symbol(j, i, shape.period_y, shape.period_x); },
      Parity::odd_along_y);
  CHECK_THROWS_WITH(scalar.set_symbol(0, 0, even, Parity::odd_along_x),
                    Catch::Contains("parity: odd along one axis needs two components"));
  Field divergence(shape.nx, shape.ny), along_y(shape.nx, shape.ny);
  gradient.apply({field.data(), second.data()}, {divergence.data(), along_y.data()});
  for (Index a = 0; a < shape.nx; ++a)
    for (Index b = 0; b < shape.ny; ++b) {
      // Rounding of two transforms of numbers of order 1.
      CHECK(result(a, b) == Approx(by_hand_even(field, shape, a, b)).margin(1e-13));
      CHECK(x(a, b) == Approx(by_hand_even(field, shape, a, b) + by_hand_odd(second, shape, a, b))
                           .margin(1e-13));
      CHECK(y(a, b) == Approx(by_hand_odd(field, shape, a, b)).margin(1e-13));
      CHECK(divergence(a, b) == Approx(by_hand_odd_along_one(field, shape, a, b, true) +
                                       by_hand_odd_along_one(second, shape, a, b, false))
                                    .margin(1e-13));
      CHECK(along_y(a, b) ==
            Approx(by_hand_odd_along_one(field, shape, a, b, false)).margin(1e-13));
    }
}

TEST_CASE("A convolution has the same bits for one thread and for two, and may work in place",
          "[convolution]") {
  const Index n = 96;
  const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> field =
      Field::Random(n, n).cast<float>();
  auto one = field, two = field, in_place = field;
  Convolution2D<float> convolution({n, n, n, n});
  convolution.set_symbol(0, 0, [](Index i, Index j) { return 1 / (1.0 + double(i * i + j * j)); });
  parallel::set_threads(1);
  convolution.apply(field.data(), one.data());
  parallel::set_threads(2);
  convolution.apply(field.data(), two.data());
  convolution.apply(in_place.data(), in_place.data());
  parallel::set_threads(0);
  CHECK((one == two).all());
  CHECK((one == in_place).all());
}

TEST_CASE("A convolution of rows that are made and taken one by one is that of the whole field",
          "[convolution]") {
  // 96 rows are six blocks of eight pairs; 45 rows have a block that is not full and a row without
  // partner.
  const Case shape = GENERATE(Case{96, 64, 96, 64}, Case{45, 20, 90, 40}, Case{1, 5, 1, 5});
  const int components = GENERATE(1, 2);
  // One row of each of the first two pairs is empty, and both rows of the third. The second
  // component has other empty rows.
  const auto empty = [&](int component, Index row) {
    const Index half = (std::min<Index>(shape.nx, 16) + 1) / 2, shifted = row - component;
    return shifted == 0 || shifted == half + 1 || shifted == 2 || shifted == half + 2;
  };
  std::array<Field, 2> fields{Field::Random(shape.nx, shape.ny), Field::Random(shape.nx, shape.ny)};
  for (int component = 0; component < 2; ++component)
    for (Index row = 0; row < shape.nx; ++row)
      if (empty(component, row)) fields[std::size_t(component)].row(row).setZero();
  Convolution2D<double> convolution({shape.nx, shape.ny, shape.period_x, shape.period_y},
                                    components);
  for (int a = 0; a < components; ++a)
    for (int b = a; b < components; ++b)
      convolution.set_symbol(
          a, b, [=](Index i, Index j) { return 1 / (1.0 + a + 2 * b + double(i * i + j * j)); });
  std::array<Field, 2> whole{fields},
      by_rows{Field::Zero(shape.nx, shape.ny), Field::Zero(shape.nx, shape.ny)};
  if (components == 1)
    convolution.apply(fields[0].data(), whole[0].data());
  else
    convolution.apply({fields[0].data(), fields[1].data()}, {whole[0].data(), whole[1].data()});
  Eigen::ArrayXXi asked = Eigen::ArrayXXi::Zero(components, shape.nx), taken = asked;
  convolution.apply(
      [&](int component, Index row, double* buffer) -> const double* {
        const double* values = fields[std::size_t(component)].data() + row * shape.ny;
        ++asked(component, row);
        if (empty(component, row)) {
          // Values left in the buffer of an empty row must be ignored.
          std::fill_n(buffer, shape.ny, 1e9);
          return nullptr;
        }
        if (row % 3 == 0) return values;
        std::copy_n(values, shape.ny, buffer);
        return buffer;
      },
      [&](int component, Index row, const double* values) {
        ++taken(component, row);
        std::copy_n(values, shape.ny, by_rows[std::size_t(component)].data() + row * shape.ny);
      });
  for (int component = 0; component < components; ++component)
    CHECK((by_rows[std::size_t(component)] == whole[std::size_t(component)]).all());
  CHECK((asked == 1).all());
  CHECK((taken == 1).all());
}

TEST_CASE(
    "A convolution may keep its spectrum in memory that is used for something else in between",
    "[convolution]") {
  const Index n = 45;
  const Field field = Field::Random(n, n);
  Field own(n, n), lent(n, n);
  Convolution2D<double> convolution({n, n, n, n});
  convolution.set_symbol(0, 0, [](Index i, Index j) { return 1 / (1.0 + double(i * i + j * j)); });
  convolution.apply(field.data(), own.data());
  const auto bytes = convolution.spectrum_bytes();
  const auto memory = large_array<unsigned char>(bytes);
  convolution.keep_spectrum_in(memory.get());
  for (int round = 0; round < 2; ++round) {
    std::fill_n(memory.get(), bytes, static_cast<unsigned char>(0xff));
    convolution.apply(field.data(), lent.data());
    CHECK((own == lent).all());
  }
  convolution.keep_spectrum_in(nullptr);
  convolution.apply(field.data(), lent.data());
  CHECK((own == lent).all());
}

TEST_CASE("Fast transform sizes have no prime factor above 5 and are even", "[convolution]") {
  CHECK(fast_transform_size(1) == 1);
  CHECK(fast_transform_size(2) == 2);
  CHECK(fast_transform_size(7) == 8);
  CHECK(fast_transform_size(257) == 270);
  CHECK(fast_transform_size(1024) == 1024);
}
