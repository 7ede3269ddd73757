// Times several things side by side: round after round each has its turn, so that whatever slows the machine down for a
// while meets all of them, and a ratio is the median of ratios within a round.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hamilcar {

// `run(n)` does the thing n times.
struct BenchmarkCase {
    std::string name;
    std::function<void(long)> run;
};

class InterleavedTimes {
public:
    // times[case_index][round]: seconds for one.
    explicit InterleavedTimes(std::vector<std::vector<double>> times) : times_(std::move(times)) {}
    // Seconds for one, the median over the rounds.
    double time(std::size_t case_index) const;
    // How many of `fast` go into one of `slow`.
    double ratio(std::size_t slow, std::size_t fast) const;

private:
    std::vector<std::vector<double>> times_;
};

// `turn`: about how long each runs at a time [s].
InterleavedTimes interleave(const std::vector<BenchmarkCase>& cases, double turn, int rounds);

double median(std::vector<double> values);

}  // namespace hamilcar
