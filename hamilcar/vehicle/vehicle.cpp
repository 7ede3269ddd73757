// The only instantiation for doubles: its many small parts take long to compile.
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

template Vehicle<double>::Vehicle(const VehicleDescription&);
template void Vehicle<double>::add_suspensions(const VehicleDescription&, const StateLayout&);
template void Vehicle<double>::add_powertrain(const VehicleDescription&, const StateLayout&);
template void Vehicle<double>::attach_to_axle(Differential<double>&);
template void Vehicle<double>::add_brakes(const VehicleDescription&, const StateLayout&);
template void Vehicle<double>::add_steering(const VehicleDescription&, const StateLayout&);
template void Vehicle<double>::add_actuators(const VehicleDescription&, const StateLayout&);

}  // namespace hamilcar
