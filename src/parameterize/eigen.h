// The parts of Eigen that are in use, under a name of our own: a program that links this library
// may use Eigen itself, compiled for other instruction sets, and the linker must not mix the two.
#pragma once

#define EIGEN_MPL2_ONLY
#define EIGEN_DONT_PARALLELIZE
#define Eigen wrapatlas_eigen
#include <Eigen/SparseCholesky>
