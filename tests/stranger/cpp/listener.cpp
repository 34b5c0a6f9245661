// A program that receives frames from other computers; built against the installed package.
#include <cstdio>
#include <motionrack/dds/subscriber.hpp>

int main() {
    motionrack::dds::SubscriberSettings settings;
    settings.bus = "not a name";
    const auto subscriber = motionrack::dds::Subscriber::open(settings);
    std::printf("%s\n", subscriber ? "listens" : "refused");
}
