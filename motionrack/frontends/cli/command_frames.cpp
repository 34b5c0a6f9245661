// frames: command group for frames of a grating bus.
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/frames.hpp>

namespace motionrack::cli {

void add_frames(CLI::App& app, Action& chosen) {
    CLI::App* group = app.add_subcommand(
        "frames", "Frames of a grating bus: show those of a rack, live; publish to and receive from other computers");
    group->require_subcommand(0, 1);
    add_frames_show(*group, chosen);
    add_frames_publish(*group, chosen);
    add_frames_subscribe(*group, chosen);
    add_frames_feed(*group, chosen);
}

}  // namespace motionrack::cli
