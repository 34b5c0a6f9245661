// Steps of the pipeline over blocks of ticks: plain loops that compilers vectorise, with the same bits on every
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5::kernels {

/// Number of ticks in a block: capacity of the arrays that the functions below take.
inline constexpr std::size_t block = 512;

void line(double* x, double* y, std::size_t n, Point from, Point step, std::int64_t first);
void hold(double* x, double* y, std::size_t n, Point p);
void add_scaled(double* x, const double* counts, std::size_t n, double scale);
void transform(double* x, double* y, std::size_t n, const Transform& t);
PlanExtent extent(const double* x, const double* y, std::size_t n);
/// Computes a head's outputs: clips to the field of 20 bits, applies the table (nullptr: none) and gain * v + offset,
/// rounds and clips.
void head(const double* x, const double* y, std::int32_t* to_x, std::int32_t* to_y, std::size_t n, const Table* table,
          Point gain, Point offset);

}  // namespace motionrack::rtc5::kernels
