// A slip or a speed over a closed cycle: a sum of harmonics with random amplitudes and phases.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace hamilcar::test {

template <std::size_t harmonics>
class History {
public:
    History(std::mt19937& source, double amplitude, double mean) : mean_(mean) {
        std::uniform_real_distribution<double> unit(-1, 1);
        for (auto& [cosine, sine] : terms_) cosine = amplitude * unit(source), sine = amplitude * unit(source);
    }
    double operator()(double phase) const {
        double sum = mean_;
        for (std::size_t n = 0; n < terms_.size(); ++n) {
            sum += terms_[n].first * std::cos((n + 1) * phase) + terms_[n].second * std::sin((n + 1) * phase);
        }
        return sum;
    }

private:
    double mean_;
    std::array<std::pair<double, double>, harmonics> terms_;
};

}  // namespace hamilcar::test
