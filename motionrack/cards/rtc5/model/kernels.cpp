// Loops over blocks. Nothing depends on the order of the elements, so vector instructions of any width give the same
// bits.
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

Extent extent(const double* x, const double* y, std::size_t n) {
    // Four of each, so that one comparison need not wait for the one before it.
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

inline double into(double v, double least, double greatest) {
    v = v < least ? least : v;
    return v > greatest ? greatest : v;
}

}  // namespace

void clip(const double* __restrict x, const double* __restrict y, double* __restrict to_x, double* __restrict to_y,
          std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to_x[i] = into(x[i], field_least, field_greatest);
    for (std::size_t i = 0; i < n; ++i) to_y[i] = into(y[i], field_least, field_greatest);
}

namespace {

/// Both coordinates of a node at once: two doubles are one register everywhere.
using Pair = double __attribute__((vector_size(16)));

inline Pair pair(const Table::Node& node) {
    return Pair{static_cast<double>(node.x), static_cast<double>(node.y)};
}

}  // namespace

void correct(double* __restrict x, double* __restrict y, std::size_t n, const Table& table) {
    const Table::Node* const nodes = table.nodes.data();
    for (std::size_t i = 0; i < n; ++i) {
        const double u = (x[i] + grid_zero) * (1 / grid_step), v = (y[i] + grid_zero) * (1 / grid_step);
        const int column = static_cast<int>(u), row = static_cast<int>(v);
        const double fx = u - column, fy = v - row;
        const Table::Node *const low = nodes + row * grid_side + column, *const high = low + grid_side;
        const Pair a = pair(low[0]), c = pair(high[0]);
        const Pair below = a + (pair(low[1]) - a) * fx, above = c + (pair(high[1]) - c) * fx;
        const Pair out = below + (above - below) * fy;
        x[i] = out[0];
        y[i] = out[1];
    }
}

void out(const double* __restrict v, std::int32_t* __restrict to, std::size_t n, double gain, double offset) {
    // Added to this number, a double keeps the nearest whole number (half to even) in its low bits.
    constexpr double whole = 6755399441055744.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double rounded = into(gain * v[i] + offset, field_least, field_greatest) + whole;
        to[i] = static_cast<std::int32_t>(std::bit_cast<std::int64_t>(rounded));
    }
}

}  // namespace motionrack::rtc5::kernels
