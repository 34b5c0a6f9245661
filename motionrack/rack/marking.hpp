// Marking machines of a rack: belts and rotary tables with their parts, and scan heads that mark them.
//
//   conveyor ──NAME.enc_a, enc_b──► card ──xout, yout, laser_on──► scan head ──► work piece on the conveyor
//      ├──NAME.mcbsp────────────────►│
//      └──NAME.sensor_n─────────────►│ start_n
#pragma once

#include <memory>
#include <motionrack/rack/config.hpp>
#include <motionrack/sim/parts/conveyor_drive.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>
#include <motionrack/sim/parts/part_sensor.hpp>
#include <motionrack/sim/parts/scan_head.hpp>
#include <motionrack/sim/parts/serial_word_source.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// One belt or rotary table of the running machine.
struct RunningConveyor {
    RackConveyor config;
    std::unique_ptr<parts::ConveyorDrive> drive;
    std::unique_ptr<parts::ConveyorPosition> counts;  ///< in encoder counts; nullptr without encoder
    std::unique_ptr<parts::LineEncoder> encoder;
    std::unique_ptr<parts::SerialWordSource> sender;    ///< may be nullptr
    std::unique_ptr<parts::ConveyorPosition> position;  ///< travel past the sensor; nullptr without sensor
    std::unique_ptr<parts::PartSensor> sensor;

    const parts::Conveyor& track() const { return drive->track(); }
    /// Returns the kernel wire of a signal.
    std::string wire_name(std::string_view end) const;
};

/// One scan head of the running machine. Its marks can be read between runs: station().workpiece() has the growing list
/// of points, and the piece being marked.
struct RunningScanner {
    RackScanner config;
    std::unique_ptr<parts::ScanHead> head;

    const parts::MarkingStation& station() const { return head->station(); }
    const parts::Workpiece& workpiece() const { return head->station().workpiece(); }
};

/// Builds a belt or table, with its parts and wires in the kernel, before the kernel starts. The config must come from
/// read_rack.
RunningConveyor build_track(sim::Kernel& kernel, const RackConveyor& config);
/// Builds a scan head. Call after building its card. `track`: the conveyor that carries its part, or nullptr.
RunningScanner build_scanner(sim::Kernel& kernel, const RackScanner& config, const parts::Conveyor* track);

}  // namespace motionrack::rack
