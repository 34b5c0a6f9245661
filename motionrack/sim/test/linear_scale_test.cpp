// The grating scale against its formula, its lines against its count, and the causes of lost counts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/sim/blocks/quadrature_counter.hpp>
#include <motionrack/sim/parts/conditions.hpp>
#include <motionrack/sim/parts/linear_scale.hpp>
#include <vector>

#include "allocation_count.hpp"
#include "fake_pulses.hpp"

namespace motionrack::parts {
namespace {

/// Counts edges on two wires while it listens.
struct Head final : sim::Device {
    Head(sim::Kernel& k, const LinearScale& scale)
        : kernel(k), id(k.add(*this, sim::Phase::cards, "head")), a(scale.a()), b(scale.b()) {
        k.listen(a, id, 0);
        k.listen(b, id, 1);
    }
    void on_scheduled(Instant) override {}
    void on_wire(int pin, int level, Instant) override {
        lines = static_cast<std::uint8_t>((lines & ~(1u << pin)) | static_cast<unsigned>(level) << pin);
        decoder.lines(lines);
    }
    void want(bool wanted, std::int64_t count) {
        kernel.subscribe(a, id, wanted);
        kernel.subscribe(b, id, wanted);
        lines = static_cast<std::uint8_t>(kernel.level(a) | kernel.level(b) << 1);
        decoder = sim::QuadratureDecoder(sim::Edges::all, lines);
        decoder.set_count(count);
    }
    sim::Kernel& kernel;
    sim::DeviceId id;
    sim::WireId a, b;
    std::uint8_t lines = 0;
    sim::QuadratureDecoder decoder;
};

struct ScaleListener final : sim::PositionListener, sim::EdgeListener {
    void crossed(Instant now) override { at = now, ++crossings; }
    void rate_changed(double, double after, Instant) override { rate = after; }
    void edges(const sim::EdgeBatch& batch) override {
        for (std::uint32_t i = 0; i < batch.size; ++i) {
            const std::int64_t to = batch.first_count + batch.step * static_cast<std::int64_t>(i);
            EXPECT_EQ(std::abs(to - count), 1);
            EXPECT_GE(batch.origin + batch.tick * batch.at[i], last);
            last = batch.origin + batch.tick * batch.at[i];
            count = to;
            ++total;
        }
    }
    Instant at{}, last{};
    double rate = 0;
    std::int64_t count = 0;
    int crossings = 0, total = 0;
};

struct ScaleRig {
    explicit ScaleRig(const LinearScaleSettings& scale_settings = {}, const LinearStageSettings& stage_settings = {})
        : stage(kernel, "x", stage_settings),
          scale(kernel, "s", stage, scale_settings),
          head(kernel, scale),
          slot(scale.add_listener(listener)) {}
    void volts(double v) {
        kernel.set_wire(stage.drive_wire(), static_cast<int>(std::lround(v * 1e6)));
        kernel.settle();
    }
    void run(double seconds) { kernel.run_until(kernel.now() + from_seconds(seconds)); }
    std::int64_t count() { return scale.count(kernel.now()); }
    bool fault(std::string_view name, double value) { return scale.fault(name, value, kernel.now()); }

    sim::Kernel kernel;
    LinearStage stage;
    LinearScale scale;
    Head head;
    ScaleListener listener;
    int slot;
};

RC_GTEST_PROP(LinearScale, CountsAsTheFormulaRequires, ()) {
    LinearScaleSettings s;
    s.pitch_pm = *rc::gen::element<std::int64_t>(20'000'000, 512'000, 8'123'457, 1'000'000'000);
    s.interpolation = *rc::gen::element<std::int64_t>(4, 1'024, 4'096, 65'536);
    s.reversed = *rc::gen::arbitrary<bool>();
    s.zero_offset_nm = *rc::gen::element(0.0, -1e6, 3e8);
    s.max_count_rate = 1e9;
    LinearStageSettings stage;
    stage.start_nm = *rc::gen::element(0.0, -9e8, 9e8);
    stage.saturation_velocity = 0.007;  // below 1e9 counts/s of the finest scale
    ScaleRig rig(s, stage);
    rig.kernel.start();
    for (int i = 0; i < 6; ++i) {
        rig.volts(*rc::gen::inRange(-100, 101) * 0.01);
        rig.run(1e-4 * *rc::gen::inRange(1, 200));
        const std::int64_t position = rig.stage.count(rig.kernel.now());
        const long double nm = static_cast<long double>(position) / 1024 - s.zero_offset_nm;
        const long double counts = nm * 1'000 * s.interpolation / s.pitch_pm;
        const auto expected = static_cast<std::int64_t>(std::floor(counts));
        RC_ASSERT(rig.scale.lost() == 0);
        // Next to a whole number, the rounding error of the long double may select the wrong count.
        if (std::fabs(counts - std::round(counts)) > 1e-3L)
            RC_ASSERT(rig.count() == (s.reversed ? -expected : expected));
        RC_ASSERT(std::fabs(rig.scale.position_nm(rig.kernel.now()) - static_cast<double>(nm)) <=
                  2 * rig.scale.nm_per_count() + 1e-6);
    }
}

TEST(LinearScale, CountsAtTwentyMegahertzOverTwoMetresAtNoCost) {
    LinearScaleSettings s;  // 4.88 nm per count
    LinearStageSettings stage;
    stage.start_nm = -1e9;
    stage.saturation_velocity = 20e6 * 20e-6 / 4'096 * 0.999'999;
    ScaleRig rig(s, stage);
    rig.kernel.start();
    rig.volts(1);
    rig.run(1);
    EXPECT_NEAR(rig.scale.rate(rig.kernel.now()), 20e6, 21);
    const std::int64_t from = rig.count();
    const std::uint64_t events = rig.kernel.events();
    rig.run(10);
    EXPECT_NEAR(static_cast<double>(rig.count() - from), 200e6 * 0.999'999, 2);
    EXPECT_LT(rig.kernel.events() - events, 10u);
    EXPECT_TRUE(rig.scale.counts_valid());
    // On a finer scale, the counts of 2 m exceed 32 bits. A card that stores the low 32 bits reconstructs the others
    // from its last reading.
    LinearScaleSettings fine;
    fine.pitch_pm = 512'000;
    fine.max_count_rate = 1e9;
    ScaleRig wide(fine, stage);
    wide.kernel.start();
    wide.volts(1);
    std::int64_t known = wide.count();
    EXPECT_LT(known, -7'900'000'000);
    for (int i = 0; i < 40; ++i) {
        wide.run(0.5);
        const auto word = static_cast<std::uint32_t>(wide.count());
        known += static_cast<std::int32_t>(word - static_cast<std::uint32_t>(known));
        ASSERT_EQ(known, wide.count());
    }
    EXPECT_GT(known, 7'000'000'000);
}

TEST(LinearScale, NotifiesAListenerAtTheInstantOfTheEdge) {
    for (const bool reversed : {false, true}) {
        LinearScaleSettings s;
        s.reversed = reversed;
        ScaleRig rig(s);
        rig.kernel.start();
        rig.volts(0.1);
        const std::int64_t there = reversed ? -1'000'000 : 1'000'000;
        rig.scale.watch(rig.slot, reversed ? there : sim::unwatched_below, reversed ? sim::unwatched_above : there);
        while (rig.listener.crossings == 0) rig.run(1e-3);
        ScaleRig again(s);
        again.kernel.start();
        again.volts(0.1);
        again.kernel.run_until(rig.listener.at - Duration{1});
        EXPECT_EQ(again.count(), there + (reversed ? 1 : -1));
        again.kernel.run_until(rig.listener.at);
        EXPECT_EQ(again.count(), there);
        // A range that is already left is reported at once, and only once.
        again.scale.watch(again.slot, sim::unwatched_below, -2'000'000);
        again.kernel.settle();
        EXPECT_EQ(again.listener.crossings, 1);
        again.run(1e-3);
        EXPECT_EQ(again.listener.crossings, 1);
    }
}

TEST(LinearScale, LinesShowTheCountWhileAListenerIsAttached) {
    LinearScaleSettings s;
    s.pitch_pm = 2'000'000;
    s.interpolation = 400;  // 5 nm
    ScaleRig rig(s);
    rig.kernel.start();
    std::uint64_t events = 0;
    for (const double volts : {0.2, -0.5, 0.3}) {
        rig.head.want(false, 0);
        rig.volts(volts);
        events = rig.kernel.events();
        rig.run(1e-2);
        EXPECT_LT(rig.kernel.events() - events, 10u) << "nobody listens";
        EXPECT_EQ(rig.kernel.level(rig.scale.a()), sim::lines_of(rig.count()) & 1);
        rig.head.want(true, rig.count());
        rig.run(2e-3);
        EXPECT_EQ(rig.head.decoder.count(), rig.count());
        EXPECT_EQ(rig.head.decoder.illegal(), 0u);
        EXPECT_GT(rig.kernel.events() - events, 400u);
    }
}

TEST(LinearScale, LinesAreExactAtTwentyMegahertz) {
    LinearScaleSettings s;
    LinearStageSettings stage;
    stage.saturation_velocity = 20e6 * 20e-6 / 4'096 * 0.999'999;
    ScaleRig rig(s, stage);
    rig.kernel.start();
    rig.volts(10);
    rig.run(0.1);
    rig.head.want(true, rig.count());
    rig.listener.count = rig.count();
    rig.scale.set_edge_listener(&rig.listener);
    const std::uint64_t before = sim::allocations();
    for (int i = 0; i < 1'000; ++i) {
        rig.kernel.run_until(rig.kernel.now() + Duration{10'007});
        ASSERT_EQ(rig.head.decoder.count(), rig.count());
    }
    EXPECT_EQ(sim::allocations(), before);
    EXPECT_NEAR(rig.listener.total, 20'014, 1);
    EXPECT_EQ(rig.listener.count, rig.count());
    EXPECT_EQ(rig.head.decoder.illegal(), 0u);
    EXPECT_EQ(rig.scale.lost(), 0);
}

TEST(LinearScale, LosesCountsThatAreTooFastAndReportsIt) {
    LinearScaleSettings s;
    s.max_count_rate = 1e6;  // 4.88 mm/s
    ScaleRig rig(s);
    rig.kernel.start();
    rig.volts(1);  // 5 m/s2: above 4.88 mm/s after 0.9766 ms
    rig.run(2e-3);
    EXPECT_TRUE(rig.scale.too_fast());
    EXPECT_FALSE(rig.scale.counts_valid());
    const std::int64_t frozen = rig.count();
    EXPECT_NEAR(static_cast<double>(frozen), 0.5 * 1e6 * 0.9765625e-3, 2);
    EXPECT_EQ(rig.scale.rate(rig.kernel.now()), 0);
    rig.volts(-1);
    rig.run(2.5e-3);
    EXPECT_FALSE(rig.scale.too_fast());
    const double truth = rig.stage.position_nm(rig.kernel.now()) / rig.scale.nm_per_count();
    EXPECT_NEAR(static_cast<double>(rig.count()), truth - static_cast<double>(rig.scale.lost()), 1.01);
    EXPECT_GT(rig.scale.lost(), 1'000);
    const auto conditions = rig.kernel.conditions();
    ASSERT_EQ(conditions.size(), 2u);
    EXPECT_NEAR(to_seconds(conditions[0].at), 0.9765625e-3, 1e-9);
    EXPECT_NE(describe(conditions[0], "s").find("above the 1000000 counts/s of its electronics"), std::string::npos);
    EXPECT_NE(describe(conditions[1], "s").find("it counts again and has lost"), std::string::npos);
    rig.scale.reference();
    EXPECT_TRUE(rig.scale.counts_valid());
}

TEST(LinearScale, FaultsChangeTheMeasuredPositionOnly) {
    LinearScaleSettings s;
    s.dirt_position_nm = 1e6;
    s.index_nm = 2e6;
    ScaleRig rig(s);
    rig.kernel.start();
    const auto truth = [&] { return rig.stage.position_nm(rig.kernel.now()) / rig.scale.nm_per_count(); };
    EXPECT_TRUE(rig.fault("scale.dirt", 10'000));
    rig.volts(0.1);
    rig.run(0.07);  // 1.2 mm
    EXPECT_NEAR(static_cast<double>(rig.count()), truth() - 2'048, 1.01) << "10 um are 2048 counts";
    rig.volts(-0.1);
    rig.run(0.15);
    rig.volts(0);
    EXPECT_NEAR(static_cast<double>(rig.count()), truth(), 1.01) << "back before the dirt";
    std::int64_t here = rig.count();
    EXPECT_TRUE(rig.fault("scale.lose", 100));
    EXPECT_EQ(rig.count(), here - 100);
    EXPECT_TRUE(rig.fault("scale.dirt", 0));
    EXPECT_TRUE(rig.fault("scale.swapped", 1));
    EXPECT_EQ(rig.count(), here - 100);
    const double from = truth();
    rig.volts(0.1);
    rig.run(0.05);
    EXPECT_NEAR(static_cast<double>(rig.count() - (here - 100)), from - truth(), 1.01);
    EXPECT_TRUE(rig.fault("scale.swapped", 0));
    EXPECT_TRUE(rig.fault("scale.expansion", 1'000));
    here = rig.count();
    const double start = truth();
    rig.run(0.05);
    EXPECT_NEAR(static_cast<double>(rig.count() - here), (truth() - start) / 1.001, 1.01);
    EXPECT_FALSE(rig.fault("scale.dirt", -1));
    EXPECT_FALSE(rig.fault("scale.expansion", std::nan("")));
    EXPECT_FALSE(rig.fault("scale.bent", 1));
}

TEST(LinearScale, TheReferenceMarkIsOneCountWide) {
    LinearScaleSettings s;
    s.index_nm = 1e6;
    ScaleRig rig(s);
    rig.kernel.start();
    rig.volts(0.1);
    for (const std::int64_t there : {204'799, 204'800, 204'801}) {
        rig.listener.crossings = 0;
        rig.scale.watch(rig.slot, sim::unwatched_below, there);
        while (rig.listener.crossings == 0) rig.kernel.run_until(rig.kernel.now() + Duration{100});
        EXPECT_EQ(rig.kernel.level(rig.scale.z()), there == 204'800) << there;
    }
}

TEST(LinearScale, MeasuresAnyPositionFunction) {
    sim::Kernel kernel;
    sim::FakePulses pulses(kernel, {{Instant{0}, microseconds(10), 1}});
    LinearScaleSettings s;
    s.pitch_pm = 20'000'000;
    s.interpolation = 40;     // 500 nm
    s.places = 25'600;        // microsteps ...
    s.places_nm = 5'000'000;  // ... of a revolution of 5 mm
    LinearScale scale(kernel, "s", pulses, s);
    kernel.start();
    kernel.run_until(whole_seconds(1));
    const std::int64_t microsteps = pulses.count(kernel.now());
    EXPECT_GT(microsteps, 99'990);
    EXPECT_EQ(scale.count(kernel.now()), microsteps * 5'000'000 / 25'600 / 500);
}

RC_GTEST_PROP(LinearScale, ASnapshotContinuesAsTheFirstTime, ()) {
    LinearScaleSettings s;
    s.max_count_rate = 5e6;
    ScaleRig rig(s);
    rig.kernel.start();
    rig.volts(1);
    rig.run(1e-4 * *rc::gen::inRange(1, 100));
    rig.fault("scale.expansion", *rc::gen::inRange(0, 1'000));
    const bool wanted = *rc::gen::arbitrary<bool>();
    if (wanted) rig.head.want(true, rig.count());
    const sim::Snapshot snapshot = rig.kernel.snapshot();
    const double volts = *rc::gen::inRange(-20, 20) * 0.1;
    std::int64_t counts[2] = {};
    std::uint64_t hashes[2] = {};
    for (int i = 0; i < 2; ++i) {
        rig.kernel.restore(snapshot);
        rig.volts(volts);
        rig.run(3e-3);
        counts[i] = rig.count();
        hashes[i] = rig.kernel.state_hash();
    }
    RC_ASSERT(counts[0] == counts[1]);
    RC_ASSERT(hashes[0] == hashes[1]);
}

}  // namespace
}  // namespace motionrack::parts
