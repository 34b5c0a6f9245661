// A flag that is set for the duration of a scope, even if an exception ends it.
#pragma once

#include <utility>

namespace motionrack::rack {

class RaisedFlag {
  public:
    explicit RaisedFlag(bool& flag) : flag_(flag), before_(std::exchange(flag, true)) {}
    ~RaisedFlag() { flag_ = before_; }
    RaisedFlag(const RaisedFlag&) = delete;
    RaisedFlag& operator=(const RaisedFlag&) = delete;

  private:
    bool& flag_;
    bool before_;
};

}  // namespace motionrack::rack
