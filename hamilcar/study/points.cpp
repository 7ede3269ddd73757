#include <cmath>
#include <limits>

#include "hamilcar/base/text.hpp"
#include "hamilcar/study/sampling.hpp"
#include "hamilcar/study/study.hpp"

namespace hamilcar {

namespace {

std::string value_at(const StudyParameter& parameter, double share) {
    if (parameter.values.empty()) return number_text(parameter.min + share * (parameter.max - parameter.min));
    return parameter.values[static_cast<std::size_t>(share * static_cast<double>(parameter.values.size()))];
}

std::string level(const StudyParameter& parameter, std::size_t number) {
    if (!parameter.values.empty()) return parameter.values[number];
    if (parameter.count == 1) return number_text(parameter.min);
    return value_at(parameter, static_cast<double>(number) / static_cast<double>(parameter.count - 1));
}

}  // namespace

std::vector<StudyPoint> points_of(const StudyDescription& study) {
    const std::vector<StudyParameter>& parameters = study.parameters;
    std::vector<StudyPoint> points;
    if (study.sampling == Sampling::full_factorial) {
        std::vector<std::size_t> counts;
        for (const StudyParameter& p : parameters) counts.push_back(p.values.empty() ? p.count : p.values.size());
        for (const std::vector<std::size_t>& levels : full_factorial(counts)) {
            points.emplace_back();
            for (std::size_t k = 0; k < levels.size(); ++k) {
                points.back().values.push_back(level(parameters[k], levels[k]));
            }
        }
    } else {
        const auto shares = study.sampling == Sampling::sobol
                                ? sobol(study.points, parameters.size())
                                : latin_hypercube(study.points, parameters.size(), study.seed);
        for (const std::vector<double>& share : shares) {
            points.emplace_back();
            for (std::size_t k = 0; k < share.size(); ++k) {
                points.back().values.push_back(value_at(parameters[k], share[k]));
            }
        }
    }
    for (StudyPoint& point : points) {
        for (const std::string& value : point.values) {
            point.numbers.push_back(number_in(value).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
    }
    return points;
}

}  // namespace hamilcar
