#include "hamilcar/io/tir_keys.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "hamilcar/description/magic_coefficients.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

using Words = std::string_view;

constexpr std::array only_old{Words("PHY3"),  Words("LGAX"),  Words("LGAY"), Words("LGAZ"),
                              Words("LSGKP"), Words("LSGAL"), Words("PTX1"), Words("PTX2"),
                              Words("PTX3"),  Words("PTY1"),  Words("PTY2")};
constexpr std::array only_new{
    Words("PPX1"),  Words("PPX2"),  Words("PPX3"), Words("PPX4"), Words("PPY1"),  Words("PPY2"),  Words("PPY3"),
    Words("PPY4"),  Words("PPY5"),  Words("PPZ1"), Words("PPZ2"), Words("PPMX1"), Words("PKY4"),  Words("PKY5"),
    Words("PKY6"),  Words("PKY7"),  Words("PEY5"), Words("RBX3"), Words("RBY4"),  Words("QDZ10"), Words("QDZ11"),
    Words("QSX4"),  Words("QSX5"),  Words("QSX6"), Words("QSX7"), Words("QSX8"),  Words("QSX9"),  Words("QSX10"),
    Words("QSX11"), Words("QSY5"),  Words("QSY6"), Words("QSY7"), Words("QSY8"),  Words("LKYC"),  Words("LKZC"),
    Words("QSX12"), Words("QSX13"), Words("QSX14")};
constexpr std::array model_keys{Words("FITTYP"),
                                Words("USE_MODE"),
                                Words("TYRESIDE"),
                                Words("LONGVL"),
                                Words("PROPERTY_FILE_FORMAT"),
                                Words("FNOMIN"),
                                Words("UNLOADED_RADIUS"),
                                Words("NOMPRES"),
                                Words("INFLPRES"),
                                Words("IP"),
                                Words("LCZ"),
                                Words("PFZ1"),
                                Words("Q_FZ1"),
                                Words("Q_FZ2"),
                                Words("QFZ1"),
                                Words("QFZ2"),
                                Words("IP_NOM"),
                                Words("QPX1"),
                                Words("VERTICAL_STIFFNESS"),
                                Words("VERTICAL_DAMPING"),
                                Words("BREFF"),
                                Words("DREFF"),
                                Words("FREFF"),
                                Words("FZMIN"),
                                Words("FZMAX"),
                                Words("KPUMIN"),
                                Words("KPUMAX"),
                                Words("ALPMIN"),
                                Words("ALPMAX"),
                                Words("CAMMIN"),
                                Words("CAMMAX"),
                                Words("LONGITUDINAL_STIFFNESS"),
                                Words("LATERAL_STIFFNESS")};

constexpr std::array unused_keys{Words("TYPE"),
                                 Words("FUNCTION_NAME"),
                                 Words("USER_SUB_ID"),
                                 Words("N_TIRE_STATES"),
                                 Words("TYPE_NUMBER"),
                                 Words("TIRE_VERSION"),
                                 Words("COMMENT"),
                                 Words("FILE_TYPE"),
                                 Words("FILE_VERSION"),
                                 Words("FILE_FORMAT"),
                                 Words("MFSAFE1"),
                                 Words("MFSAFE2"),
                                 Words("MFSAFE3"),
                                 Words("VXLOW"),
                                 Words("ROAD_INCREMENT"),
                                 Words("ROAD_DIRECTION"),
                                 Words("TYRE_VERSION"),
                                 Words("HMAX_LOCAL"),
                                 Words("TIME_SWITCH_INTEG"),
                                 Words("SWITCH_INTEG"),

                                 Words("WIDTH"),
                                 Words("RIM_RADIUS"),
                                 Words("RIM_WIDTH"),
                                 Words("ASPECT_RATIO"),
                                 Words("BOTTOM_OFFST"),
                                 Words("BOTTOM_STIFF"),
                                 Words("PRESMIN"),
                                 Words("PRESMAX"),
                                 Words("ANGLE_RANGE"),
                                 Words("MASS"),
                                 Words("IXX"),
                                 Words("IYY"),
                                 Words("IZZ"),
                                 Words("BELT_MASS"),
                                 Words("BELT_IXX"),
                                 Words("BELT_IYY"),
                                 Words("BELT_IZZ"),
                                 Words("GRAVITY"),
                                 Words("M_A"),
                                 Words("I_AY"),
                                 Words("I_AXZ"),
                                 Words("M_B"),
                                 Words("I_BY"),
                                 Words("I_BXZ"),
                                 Words("M_R"),
                                 Words("PCFX1"),
                                 Words("PCFX2"),
                                 Words("PCFX3"),
                                 Words("PCFY1"),
                                 Words("PCFY2"),
                                 Words("PCFY3"),
                                 Words("PCMZ1"),
                                 Words("Q_RE0"),
                                 Words("Q_V1"),
                                 Words("Q_V2"),
                                 Words("Q_FZ3"),
                                 Words("Q_FCX"),
                                 Words("Q_FCY"),
                                 Words("Q_FCY2"),
                                 Words("Q_CAM"),
                                 Words("Q_CAM1"),
                                 Words("Q_CAM2"),
                                 Words("Q_CAM3"),
                                 Words("Q_FYS1"),
                                 Words("Q_FYS2"),
                                 Words("Q_FYS3"),
                                 Words("YAW_STIFFNESS"),
                                 Words("FREQ_LONG"),
                                 Words("FREQ_LAT"),
                                 Words("FREQ_YAW"),
                                 Words("FREQ_WINDUP"),
                                 Words("DAMP_LONG"),
                                 Words("DAMP_LAT"),
                                 Words("DAMP_YAW"),
                                 Words("DAMP_WINDUP"),
                                 Words("DAMP_RESIDUAL"),
                                 Words("DAMP_VLOW"),
                                 Words("Q_BVX"),
                                 Words("Q_BVT"),
                                 Words("Q_RA1"),
                                 Words("Q_RA2"),
                                 Words("Q_RB1"),
                                 Words("Q_RB2"),
                                 Words("Q_A1"),
                                 Words("Q_A2"),
                                 Words("ELLIPS_SHIFT"),
                                 Words("ELLIPS_LENGTH"),
                                 Words("ELLIPS_HEIGHT"),
                                 Words("ELLIPS_ORDER"),
                                 Words("ELLIPS_MAX_STEP"),
                                 Words("ELLIPS_NWIDTH"),
                                 Words("ELLIPS_NLENGTH"),
                                 Words("ENV_C1"),
                                 Words("ENV_C2"),
                                 Words("PDXP1"),
                                 Words("PDXP2"),
                                 Words("PDXP3"),
                                 Words("PKYP1"),
                                 Words("PDYP1"),
                                 Words("PDYP2"),
                                 Words("PDYP3"),
                                 Words("PDYP4"),
                                 Words("PHYP1"),
                                 Words("PHYP2"),
                                 Words("PHYP3"),
                                 Words("PHYP4"),
                                 Words("PECP1"),
                                 Words("PECP2"),
                                 Words("QDTP1"),
                                 Words("QCRP1"),
                                 Words("QCRP2"),
                                 Words("QBRP1"),
                                 Words("QDRP1"),
                                 Words("QDRP2"),
                                 Words("QTZ1"),
                                 Words("MBELT"),
                                 Words("LMUV"),
                                 Words("LIP"),
                                 Words("LGYR"),
                                 Words("LKYG"),
                                 Words("QFZ3"),
                                 Words("QV1"),
                                 Words("QV2"),
                                 Words("QFCX"),
                                 Words("QFCY"),
                                 Words("QFCG"),
                                 Words("QPFZ1"),
                                 Words("PTX4"),
                                 Words("PTY3"),
                                 Words("LMP"),
                                 Words("LKG"),
                                 Words("BOTTOMING_RADIUS"),
                                 Words("QRE0"),
                                 Words("QCZ2")};

const std::vector<std::string_view>& all_keys() {
    static const std::vector<std::string_view> keys = [] {
        std::vector<std::string_view> all(model_keys.begin(), model_keys.end());
        all.insert(all.end(), unused_keys.begin(), unused_keys.end());
        for (const MagicCoefficient& coefficient : magic_coefficients) all.push_back(coefficient.name);
        return all;
    }();
    return keys;
}

template <class List>
bool holds(const List& list, std::string_view key) {
    return std::ranges::find(list, key) != list.end();
}

}  // namespace

bool expected(std::string_view coefficient, bool old) {
    return !(old ? holds(only_new, coefficient) : holds(only_old, coefficient));
}

bool is_known_but_unused(std::string_view key) {
    return holds(unused_keys, key);
}

std::optional<std::string_view> nearest_key(std::string_view key) {
    return nearest_word(key, all_keys());
}

}  // namespace hamilcar::io
