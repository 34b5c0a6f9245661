// The marking machines of a rack: belts and rotary tables with what is on them, and scan heads that mark the parts.
//
//   track ──NAME.enc_a, enc_b──► card ──xout, yout, laser_on──► scan head ──► work piece on the track
//      ├──NAME.mcbsp──────────────►│
//      └──NAME.sensor_n───────────►│ start_n
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
    std::unique_ptr<parts::ConveyorPosition> counts;  ///< what its encoder sees; this and the encoder may be nullptr
    std::unique_ptr<parts::LineEncoder> encoder;
    std::unique_ptr<parts::SerialWordSource> sender;  ///< may be nullptr
    std::unique_ptr<parts::ConveyorPosition> place;   ///< of the parts; this and the sensor may be nullptr
    std::unique_ptr<parts::PartSensor> sensor;

    const parts::Conveyor& track() const { return drive->track(); }
    /// The kernel's wire of an end.
    std::string wire_name(std::string_view end) const;
    /// Faults that it can have: of the drive, the encoder and the sender; and the device that takes one.
    std::vector<std::string_view> fault_names() const;
    sim::DeviceId device_of(std::string_view fault) const;
};

/// One scan head of the running machine. What it has marked can be looked at between runs: station().workpiece() has
/// points, which grow, and the piece that is being marked.
struct RunningScanner {
    RackScanner config;
    std::unique_ptr<parts::ScanHead> head;

    const parts::MarkingStation& station() const { return head->station(); }
    const parts::Workpiece& workpiece() const { return head->station().workpiece(); }
};

/// Adds its parts and wires to the kernel, before it starts. The config must come from read_rack.
RunningConveyor build_track(sim::Kernel& kernel, const RackConveyor& config);
/// After its card. `track`: what its part is on, or nullptr.
RunningScanner build_scanner(sim::Kernel& kernel, const RackScanner& config, const parts::Conveyor* track);

}  // namespace motionrack::rack
