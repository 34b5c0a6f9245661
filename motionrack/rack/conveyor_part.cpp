// A belt or rotary table as a part: its quantities, and how its velocity is set.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/table_part.hpp>

namespace motionrack::rack {

namespace {

bool has_conveyor_encoder(const RunningConveyor& conveyor) {
    return conveyor.encoder != nullptr;
}

constexpr std::string_view conveyor_velocity = "speed_{u}_s";
constexpr std::array<QuantityRow<RunningConveyor>, 6> conveyor_quantities = {{
    {"position_{u}", "its travel since the start",
     [](RunningConveyor& conveyor, Instant now) { return conveyor.track().travel(to_seconds(now)); },
     ValueKind::measures},
    {conveyor_velocity, "its velocity, signed",
     [](RunningConveyor& conveyor, Instant now) { return conveyor.track().velocity(to_seconds(now)); },
     ValueKind::measures},
    {"encoder_counts", "counts of its encoder",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.encoder->count()); },
     ValueKind::whole, has_conveyor_encoder},
    {"lost_counts", "counts that the encoder lost above its maximum rate",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.encoder->lost()); },
     ValueKind::amount, has_conveyor_encoder},
    {"word", "the sender's last complete word",
     [](RunningConveyor& conveyor, Instant) { return static_cast<double>(conveyor.sender->word()); }, ValueKind::whole,
     [](const RunningConveyor& conveyor) { return conveyor.sender != nullptr; }},
    {"parts", "number of parts that reached the sensor",
     [](RunningConveyor& conveyor, Instant now) { return static_cast<double>(conveyor.sensor->parts(now)); },
     ValueKind::whole, [](const RunningConveyor& conveyor) { return conveyor.sensor != nullptr; }},
}};

class ConveyorPart final : public TablePart<RunningConveyor> {
  public:
    explicit ConveyorPart(RunningConveyor& conveyor)
        : TablePart(conveyor.config.name, conveyor.config.unit(), conveyor, conveyor_quantities) {}

    std::optional<QuantityLimits> limits_to_set(std::string_view quantity_name, Instant) override {
        if (quantity_name != velocity_name()) return std::nullopt;
        const double max_velocity = running_.config.max_velocity();
        return QuantityLimits{-max_velocity, max_velocity};
    }
    Result<std::string> fault_to_set(std::string_view quantity_name, double value, Instant) override {
        if (quantity_name != velocity_name())
            return fail(ErrorKind::refused, fmt::format("Of {} only {} can be set, not {}. Nothing was done.", name(),
                                                        velocity_name(), in_quotes(quantity_name)));
        const double max_velocity = running_.config.max_velocity();
        if (!(std::fabs(value) <= max_velocity))
            return fail(ErrorKind::refused,
                        fmt::format("{} cannot become {}: {:.6g} to {:.6g} are possible. Nothing was done.",
                                    full_name(quantity_name), value, -max_velocity, max_velocity));
        return fmt::format("drive.speed={:.17g}", value);
    }

  private:
    std::string velocity_name() const { return with_unit(conveyor_velocity, running_.config.unit()); }
};

void add_conveyor_parts(Rack& rack, std::vector<std::unique_ptr<Part>>& parts) {
    for (RunningConveyor& conveyor : rack.tracks()) parts.push_back(std::make_unique<ConveyorPart>(conveyor));
}

}  // namespace

constinit const PartKind conveyor_part_kind = {"conveyor", add_conveyor_parts, declared<conveyor_quantities>};

}  // namespace motionrack::rack
