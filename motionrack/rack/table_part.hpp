// A part whose quantities and faults are the rows of two tables. Only the files of parts (*_part.cpp) use it.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/rack/part.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <motionrack/sim/kernel.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::rack {

/// A row of the table of a kind of part. `Running`: its struct in the running rack.
template <class Running>
struct QuantityRow {
    std::string_view name;  ///< "{u}" stands for mm or deg
    std::string_view doc;
    double (*get)(Running& running, Instant now);
    ValueKind values;
    bool (*present)(const Running& running) = nullptr;  ///< nullptr: always
};

/// A row of the table of faults of a kind of part.
template <class Running>
struct FaultRow {
    std::string_view name;
    double min, max;
    std::string_view unit, doc;
    /// Returns the device that accepts the fault; nothing if it is missing.
    std::optional<sim::DeviceId> (*device)(const Running& running);
    double (*max_of)(const Running& running) = nullptr;  ///< replaces max; may be nullptr
};

/// Limits of faults that several kinds of part have.
inline constexpr double max_wrong_levels = 1e6, max_edge_delay_s = 1, max_factor = 1000;

/// Returns nullptr if no row has that name.
template <class Row>
const Row* find_row(std::span<const Row> rows, std::string_view name) {
    for (const Row& row : rows)
        if (row.name == name) return &row;
    return nullptr;
}

template <class Running>
class TablePart : public Part {
  public:
    /// `unit`: "mm" or "deg", replaces "{u}" in the names of the quantities. `running` stays where it is as long as the
    /// rack exists.
    TablePart(std::string name, std::string_view unit, Running& running, std::span<const QuantityRow<Running>> rows,
              std::span<const FaultRow<Running>> faults)
        : running_(running), name_(std::move(name)), unit_(unit), rows_(rows), faults_(faults) {}

    const std::string& name() const final { return name_; }
    std::vector<Quantity> quantities() final {
        std::vector<Quantity> out;
        for (const QuantityRow<Running>& row : rows_)
            if (has(row))
                out.push_back({with_unit(row.name, unit_), row.doc, row.values,
                               [&running = running_, get = row.get](Instant now) { return get(running, now); }});
        return out;
    }
    std::optional<double> quantity(std::string_view quantity_name, Instant now) final {
        for (const QuantityRow<Running>& row : rows_)
            if (has(row) && with_unit(row.name, unit_) == quantity_name) return row.get(running_, now);
        return std::nullopt;
    }

    std::vector<std::string_view> fault_names() const override {
        std::vector<std::string_view> out;
        for (const FaultRow<Running>& row : faults_) out.push_back(row.name);
        return out;
    }
    bool can_have(std::string_view fault) const final {
        const FaultRow<Running>* row = find_row(faults_, fault);
        return row != nullptr && row->device(running_).has_value();
    }
    FaultRange fault_range(std::string_view fault) const override {
        const FaultRow<Running>& row = known_row(fault);
        return {std::string(row.unit), row.doc, row.min, row.max_of == nullptr ? row.max : row.max_of(running_)};
    }
    sim::DeviceId device_of(std::string_view fault) const final {
        const std::optional<sim::DeviceId> device = known_row(fault).device(running_);
        MOTIONRACK_ASSERT(device.has_value());  // see can_have
        return *device;
    }
    bool inject(sim::Kernel& kernel, std::string_view fault, double value) final {
        return can_have(fault) && kernel.device(device_of(fault)).fault(fault, value, kernel.now());
    }

  protected:
    Running& running_;

  private:
    const FaultRow<Running>& known_row(std::string_view fault) const {
        const FaultRow<Running>* row = find_row(faults_, fault);
        MOTIONRACK_ASSERT(row != nullptr);  // names come from fault_names()
        return *row;
    }
    bool has(const QuantityRow<Running>& row) const { return row.present == nullptr || row.present(running_); }

    std::string name_;
    std::string_view unit_;
    std::span<const QuantityRow<Running>> rows_;
    std::span<const FaultRow<Running>> faults_;
};

/// Names and descriptions of a table's rows.
template <const auto& rows>
std::vector<DeclaredQuantity> declared() {
    std::vector<DeclaredQuantity> out;
    for (const auto& row : rows) out.push_back({row.name, row.doc});
    return out;
}
template <const auto& rows>
std::vector<std::string_view> names_of() {
    std::vector<std::string_view> out;
    for (const auto& row : rows) out.push_back(row.name);
    return out;
}

}  // namespace motionrack::rack
