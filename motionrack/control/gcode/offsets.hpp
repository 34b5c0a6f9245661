// The offsets between program and machine coordinates and the tool table: after the last line, and with the changes of
// the current one.
#pragma once

#include <motionrack/control/gcode/work_frame.hpp>
#include <optional>

namespace motionrack::control::gcode {

class Offsets {
  public:
    void start(const Settings& settings);

    const WorkFrame& frame() const { return frame_; }  ///< frame after the last line
    const ToolTable& tools() const { return tools_; }
    /// Returns the frame with the changes of the current line.
    const WorkFrame& next_frame() const { return frame_edited_ ? next_frame_ : frame_; }
    bool is_frame_edited() const { return frame_edited_; }

    void begin_line() {
        frame_edited_ = false;
        tool_edited_.reset();
    }
    /// Returns the frame for changes by the current line; it becomes active if the line is valid.
    WorkFrame& edit_frame();
    void edit_tool(const Tool& tool) { tool_edited_ = tool; }
    void commit();

    // Changes outside of a line.
    void activate(int system) { frame_.activate(system); }
    void reset_rotation(int system);
    void restore(const WorkFrame& earlier, int system);
    void set_probe_result(bool hit, const Point& at);

  private:
    WorkFrame frame_;
    ToolTable tools_;
    WorkFrame next_frame_;
    bool frame_edited_ = false;
    std::optional<Tool> tool_edited_;  ///< tool as changed by G10 L1, L10 or L11
};

}  // namespace motionrack::control::gcode
