// What one thread rings and another waits for in its event loop: an eventfd. Ringing costs a microsecond and never waits;
// a frame is on its way at once, where looking every few milliseconds would keep it lying about.
#pragma once

namespace hamilcar::live {

class Bell {
public:
    Bell();  // throws io::Error(input_output) where the system gives no descriptor
    ~Bell();
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    void ring() const;
    void silence() const;  // until it rings again
    int descriptor() const { return descriptor_; }

private:
    int descriptor_;
};

}  // namespace hamilcar::live
