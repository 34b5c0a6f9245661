// Loops over blocks. Their results do not depend on the order of the elements, so vector instructions of any width give
// the same bits.
#include <algorithm>
#include <bit>
#include <motionrack/cards/rtc5/model/kernels.hpp>

namespace motionrack::rtc5::kernels {

void line(double* __restrict x, double* __restrict y, std::size_t n, Point from, Point step, std::int64_t first) {
    const double begin = static_cast<double>(first);
    for (std::size_t i = 0; i < n; ++i) {
        const double at = begin + static_cast<double>(static_cast<std::int32_t>(i));
        x[i] = from.x + at * step.x;
        y[i] = from.y + at * step.y;
    }
}

void hold(double* x, double* y, std::size_t n, Point p) {
    std::fill_n(x, n, p.x);
    std::fill_n(y, n, p.y);
}

void add_scaled(double* __restrict x, const double* __restrict counts, std::size_t n, double scale) {
    for (std::size_t i = 0; i < n; ++i) x[i] += scale * counts[i];
}

void transform(double* __restrict x, double* __restrict y, std::size_t n, const Transform& t) {
    const auto [a, b, c, d] = t.product;
    const Point o = t.offset;
    for (std::size_t i = 0; i < n; ++i) {
        const double u = x[i], v = y[i];
        x[i] = a * u + b * v + o.x;
        y[i] = c * u + d * v + o.y;
    }
}

PlanExtent extent(const double* x, const double* y, std::size_t n) {
    // Four minima and maxima each, so that one comparison need not wait for the previous one.
    double lx[4], gx[4], ly[4], gy[4];
    for (int k = 0; k < 4; ++k) lx[k] = gx[k] = x[0], ly[k] = gy[k] = y[0];
    std::size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (std::size_t k = 0; k < 4; ++k) {
            lx[k] = x[i + k] < lx[k] ? x[i + k] : lx[k];
            gx[k] = x[i + k] > gx[k] ? x[i + k] : gx[k];
            ly[k] = y[i + k] < ly[k] ? y[i + k] : ly[k];
            gy[k] = y[i + k] > gy[k] ? y[i + k] : gy[k];
        }
    for (; i < n; ++i) {
        lx[0] = std::min(lx[0], x[i]), gx[0] = std::max(gx[0], x[i]);
        ly[0] = std::min(ly[0], y[i]), gy[0] = std::max(gy[0], y[i]);
    }
    return {std::min({lx[0], lx[1], lx[2], lx[3]}), std::max({gx[0], gx[1], gx[2], gx[3]}),
            std::min({ly[0], ly[1], ly[2], ly[3]}), std::max({gy[0], gy[1], gy[2], gy[3]})};
}

namespace {

/// Both coordinates of a position: two doubles fill one vector register of every target.
using Pair = double __attribute__((vector_size(16)));
using Whole = std::int64_t __attribute__((vector_size(16)));

inline Pair node(const Table::GridNode& n) {
    return Pair{static_cast<double>(n.x), static_cast<double>(n.y)};
}
inline double into_field(double v) {
    v = v > min_field ? v : min_field;
    return v < max_field ? v : max_field;
}

template <bool corrected>
void head_loop(const double* __restrict x, const double* __restrict y, std::int32_t* __restrict to_x,
               std::int32_t* __restrict to_y, std::size_t n, const Table* table, Pair gain, Pair offset) {
    // Adding this number leaves the nearest whole number (half to even) in the low bits of a double.
    constexpr Pair whole = {6755399441055744.0, 6755399441055744.0};
    for (std::size_t i = 0; i < n; ++i) {
        Pair v = {into_field(x[i]), into_field(y[i])};
        if constexpr (corrected) {
            const Pair u = (v + grid_zero) * (1 / grid_step);
            const int column = static_cast<int>(u[0]), row = static_cast<int>(u[1]);
            const double fx = u[0] - column, fy = u[1] - row;
            const Table::GridNode *const low = table->nodes.data() + row * grid_side + column, *const high =
                                                                                                   low + grid_side;
            const Pair a = node(low[0]), c = node(high[0]);
            const Pair below = a + (node(low[1]) - a) * fx, above = c + (node(high[1]) - c) * fx;
            v = below + (above - below) * fy;
        }
        v = gain * v + offset;
        const Whole bits = std::bit_cast<Whole>(Pair{into_field(v[0]), into_field(v[1])} + whole);
        to_x[i] = static_cast<std::int32_t>(bits[0]);
        to_y[i] = static_cast<std::int32_t>(bits[1]);
    }
}

}  // namespace

void head(const double* x, const double* y, std::int32_t* to_x, std::int32_t* to_y, std::size_t n, const Table* table,
          Point gain, Point offset) {
    const Pair g = {gain.x, gain.y}, o = {offset.x, offset.y};
    if (table != nullptr)
        head_loop<true>(x, y, to_x, to_y, n, table, g, o);
    else
        head_loop<false>(x, y, to_x, to_y, n, table, g, o);
}

}  // namespace motionrack::rtc5::kernels
