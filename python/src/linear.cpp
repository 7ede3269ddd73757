// Operating points, and the exact linear model about them.
#include <memory>

#include "documents.hpp"
#include "hamilcar/analysis/modes.hpp"
#include "hamilcar/io/error.hpp"
#include "python.hpp"

namespace hamilcar::python {

namespace {

struct Linear {
    OperatingPoint at;
    LinearModel model;
    std::vector<Mode> modes;
};

NewNumbers matrix(const Eigen::MatrixXd& from) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < from.rows(); ++i) {
        for (Eigen::Index j = 0; j < from.cols(); ++j) values.push_back(from(i, j));
    }
    return new_numbers(std::move(values),
                       {static_cast<std::size_t>(from.rows()), static_cast<std::size_t>(from.cols())});
}
NewNumbers vector(const Eigen::VectorXd& from) {
    return new_numbers({from.begin(), from.end()}, {static_cast<std::size_t>(from.size())});
}

std::unique_ptr<Linear> linearize(const VehicleDocument& vehicle, double speed, double lateral_acceleration) {
    if (!(speed >= 0) || !std::isfinite(speed + lateral_acceleration)) {
        throw nb::value_error("expected a speed not below zero [m/s] and a lateral acceleration [m/s^2]");
    }
    if (speed == 0 && lateral_acceleration != 0) {
        throw nb::value_error("a lateral acceleration needs a speed above zero [m/s]");
    }
    const VehicleDescription driven = vehicle.description;  // a copy: another thread may change the document meanwhile
    const nb::gil_scoped_release release;
    const Linearizer linearizer(driven);
    auto out = std::make_unique<Linear>();
    out->at = linearizer.operating_point({speed, lateral_acceleration});
    if (!out->at.found) throw io::Error(io::ExitCode::numerical, driven.name + ": " + out->at.problem);
    out->model = linearizer.linearize(out->at);
    out->modes = modes(out->model, linearizer.vehicle());
    return out;
}

}  // namespace

void add_linear(nb::module_& module) {
    nb::class_<Linear>(module, "Linear")
        .def("A", [](const Linear& linear) { return matrix(linear.model.A); })
        .def("B", [](const Linear& linear) { return matrix(linear.model.B); })
        .def("C", [](const Linear& linear) { return matrix(linear.model.C); })
        .def("D", [](const Linear& linear) { return matrix(linear.model.D); })
        .def("state", [](const Linear& linear) { return vector(linear.at.z); })
        .def("output", [](const Linear& linear) { return vector(linear.model.output); })
        .def_prop_ro("states", [](const Linear& linear) { return linear.model.states; })
        .def_prop_ro("inputs", [](const Linear& linear) { return linear.model.inputs; })
        .def_prop_ro("outputs", [](const Linear& linear) { return linear.model.outputs; })
        .def_prop_ro("output_units", [](const Linear& linear) { return linear.model.output_units; })
        .def_prop_ro("rack", [](const Linear& linear) { return linear.at.input.rack.displacement; })
        .def_prop_ro("drive_torque", [](const Linear& linear) { return linear.at.input.drive_torque; })
        .def_prop_ro("residual", [](const Linear& linear) { return linear.at.residual; })
        .def_prop_ro("modes", [](const Linear& linear) {
            nb::list out;
            for (const Mode& mode : linear.modes) {
                out.append(nb::make_tuple(mode.name, mode.eigenvalue.real(), mode.eigenvalue.imag(), mode.frequency,
                                          mode.damping_ratio));
            }
            return out;
        });
    module.def("linearize", &linearize, "vehicle"_a, "speed"_a, "lateral_acceleration"_a);
}

}  // namespace hamilcar::python
