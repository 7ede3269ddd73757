// A controller outside of the program: it leaves every command as it was told, through Simulation::set_commands.
#include "hamilcar/control/kinds.hpp"

namespace hamilcar {

namespace {

class External final : public Controller {
public:
    std::size_t memory_size() const override { return 0; }
    void decide(const Measured&, std::span<double>, const Commands&) const override {}
    double activity(std::span<const double>) const override { return 0; }
};

}  // namespace

ControllerKind external_control() {
    return {.keyword = "external",
            .meaning = "commands come from outside, as from a bench or a learner",
            .keys = {},
            .lacks = [](const VehicleDescription&) { return std::string(); },
            .make = [](const ControllerSettings&, const ControlledCar&) -> std::unique_ptr<const Controller> {
                return std::make_unique<External>();
            }};
}

}  // namespace hamilcar
