#include "hamilcar/math/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace hamilcar {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
    return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

}  // namespace hamilcar
