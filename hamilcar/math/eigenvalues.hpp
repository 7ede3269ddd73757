// Eigenvalues of a square matrix. As the decompositions of dense.hpp, compiled here once.
#pragma once

#include "hamilcar/math/eigen.hpp"

namespace hamilcar {

// In no particular order, conjugate pairs as two.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace hamilcar
