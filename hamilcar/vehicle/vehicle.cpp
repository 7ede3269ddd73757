// The one place where a car of plain numbers is built: its many small parts take the compiler long.
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

template Vehicle<double>::Vehicle(const VehicleDescription&);
template void Vehicle<double>::add_suspensions(const VehicleDescription&);
template void Vehicle<double>::add_powertrain(const VehicleDescription&);

}  // namespace hamilcar
