// Frames from other computers, in a stranger's program.
#include <cstdio>
#include <motionrack/dds/subscriber.hpp>

int main() {
    motionrack::dds::SubscriberSettings settings;
    settings.bus = "not a name";
    const auto subscriber = motionrack::dds::Subscriber::open(settings);
    std::printf("%s\n", subscriber ? "listens" : "refused");
}
