// Two doubles in one register, added, multiplied and compared side by side: for tables that are read outside the recorded step.
#pragma once

namespace hamilcar {

typedef double DoublePair __attribute__((vector_size(16)));

}  // namespace hamilcar
