// Recordings written by hand: channels over time, as a drive would have recorded them.
#pragma once

#include "hamilcar/run/channel_names.hpp"
#include "hamilcar/run/recording.hpp"

namespace hamilcar::test {

// Row by row: f(time) gives the values of all channels.
template <class F>
Recording recorded(const std::vector<std::string>& channels, const std::vector<double>& times, F&& f) {
    std::vector<io::Column> columns;
    for (const std::string& name : channels) columns.push_back({name, "", ""});
    Recording out(columns);
    for (const double time : times) out.add(time, f(time));
    return out;
}

// At `rate` [Hz] from 0 on.
inline std::vector<double> instants(double rate, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(i / rate);
    return out;
}

}  // namespace hamilcar::test
