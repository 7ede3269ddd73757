// The words of a list stand between blanks.
#include "hamilcar/io/tir_keys.hpp"

#include <algorithm>
#include <vector>

#include "hamilcar/description/magic_coefficients.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

constexpr std::string_view only_old = "PHY3 LGAX LGAY LGAZ LSGKP LSGAL PTX1 PTX2 PTX3 PTY1 PTY2";
constexpr std::string_view only_new =
    "PPX1 PPX2 PPX3 PPX4 PPY1 PPY2 PPY3 PPY4 PPY5 PPZ1 PPZ2 PPMX1 PKY4 PKY5 PKY6 PKY7 PEY5 RBX3 RBY4 QDZ10 QDZ11 "
    "QSX4 QSX5 QSX6 QSX7 QSX8 QSX9 QSX10 QSX11 QSY5 QSY6 QSY7 QSY8 LKYC LKZC QSX12 QSX13 QSX14";
constexpr std::string_view model_keys =
    "FITTYP USE_MODE TYRESIDE LONGVL PROPERTY_FILE_FORMAT FNOMIN UNLOADED_RADIUS LOADED_RADIUS NOMPRES INFLPRES IP LCZ "
    "PFZ1 "
    "Q_FZ1 Q_FZ2 QFZ1 QFZ2 IP_NOM QPX1 VERTICAL_STIFFNESS VERTICAL_DAMPING BREFF DREFF FREFF FZMIN FZMAX KPUMIN "
    "KPUMAX ALPMIN ALPMAX CAMMIN CAMMAX LONGITUDINAL_STIFFNESS LATERAL_STIFFNESS";
constexpr std::string_view unused_keys =
    "TYPE FUNCTION_NAME USER_SUB_ID N_TIRE_STATES TYPE_NUMBER TIRE_VERSION COMMENT FILE_TYPE FILE_VERSION "
    "FILE_FORMAT MFSAFE1 MFSAFE2 MFSAFE3 VXLOW ROAD_INCREMENT ROAD_DIRECTION TYRE_VERSION HMAX_LOCAL "
    "TIME_SWITCH_INTEG SWITCH_INTEG WIDTH RIM_RADIUS RIM_WIDTH ASPECT_RATIO BOTTOM_OFFST BOTTOM_STIFF PRESMIN "
    "PRESMAX ANGLE_RANGE MASS IXX IYY IZZ BELT_MASS BELT_IXX BELT_IYY BELT_IZZ GRAVITY M_A I_AY I_AXZ M_B I_BY "
    "I_BXZ M_R PCFX1 PCFX2 PCFX3 PCFY1 PCFY2 PCFY3 PCMZ1 Q_RE0 Q_V1 Q_V2 Q_FZ3 Q_FCX Q_FCY Q_FCY2 Q_CAM Q_CAM1 "
    "Q_CAM2 Q_CAM3 Q_FYS1 Q_FYS2 Q_FYS3 YAW_STIFFNESS FREQ_LONG FREQ_LAT FREQ_YAW FREQ_WINDUP DAMP_LONG DAMP_LAT "
    "DAMP_YAW DAMP_WINDUP DAMP_RESIDUAL DAMP_VLOW Q_BVX Q_BVT Q_RA1 Q_RA2 Q_RB1 Q_RB2 Q_A1 Q_A2 ELLIPS_SHIFT "
    "ELLIPS_LENGTH ELLIPS_HEIGHT ELLIPS_ORDER ELLIPS_MAX_STEP ELLIPS_NWIDTH ELLIPS_NLENGTH ENV_C1 ENV_C2 PDXP1 "
    "PDXP2 PDXP3 PKYP1 PDYP1 PDYP2 PDYP3 PDYP4 PHYP1 PHYP2 PHYP3 PHYP4 PECP1 PECP2 QDTP1 QCRP1 QCRP2 QBRP1 QDRP1 "
    "QDRP2 QTZ1 MBELT LMUV LIP LGYR LKYG QFZ3 QV1 QV2 QFCX QFCY QFCG QPFZ1 PTX4 PTY3 LMP LKG BOTTOMING_RADIUS "
    "QRE0 QCZ2";

std::vector<std::string_view> words_of(std::string_view list) {
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; begin < list.size();) {
        const std::size_t end = std::min(list.find(' ', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

bool holds(std::string_view list, std::string_view key) {
    for (std::size_t at = list.find(key); at != std::string_view::npos && !key.empty(); at = list.find(key, at + 1)) {
        const std::size_t end = at + key.size();
        if ((at == 0 || list[at - 1] == ' ') && (end == list.size() || list[end] == ' ')) return true;
    }
    return false;
}

const std::vector<std::string_view>& all_keys() {
    static const std::vector<std::string_view> keys = [] {
        std::vector<std::string_view> all = words_of(model_keys);
        for (const std::string_view key : words_of(unused_keys)) all.push_back(key);
        for (const MagicCoefficient& coefficient : magic_coefficients) all.push_back(coefficient.name);
        return all;
    }();
    return keys;
}

}  // namespace

bool expected(std::string_view coefficient, bool old) {
    return !holds(old ? only_new : only_old, coefficient);
}

bool is_known_but_unused(std::string_view key) {
    return holds(unused_keys, key);
}

std::optional<std::string_view> nearest_key(std::string_view key) {
    return nearest_word(key, all_keys());
}

}  // namespace hamilcar::io
