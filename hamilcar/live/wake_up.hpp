// A wake-up event from one thread to the event loop of another: an eventfd. Signaling costs a microsecond and never blocks, and a
// frame is sent at once; polling would delay it by up to a polling interval.
#pragma once

namespace hamilcar::live {

class WakeUp {
public:
    WakeUp();  // throws io::Error(input_output) if no descriptor is available
    ~WakeUp();
    WakeUp(const WakeUp&) = delete;
    WakeUp& operator=(const WakeUp&) = delete;

    void signal() const;
    void clear() const;  // until the next signal
    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

}  // namespace hamilcar::live
