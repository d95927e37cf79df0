#pragma once

#include "support/deformed_point.hpp"
#include "synovia/synovia.hpp"

#include <complex>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace synovia
{

using Complex = std::complex<mfem::real_t>;

/// What energies depend on; complex, for their derivatives.
struct Invariants
{
   Complex I1;
   Complex I2;
   Complex J;
   /// n . C n and n . C^2 n for the fibers' direction n.
   Complex In;
   Complex In2;
};

/// A law with values for its parameters, and its energy per undeformed volume,
/// written down once more.
struct LawSample
{
   std::string name;
   std::map<std::string, mfem::real_t> values;
   std::function<Complex(const Invariants &)> energy;
};

/// Of all laws that have an energy, fibers along SomeDirection().
std::vector<LawSample> LawSamples();
constexpr mfem::real_t sample_solid_fraction = 0.2;

/// The derivative of the energy by the deformation gradient, by complex steps.
Tensor3<> EnergyDerivative(const LawSample &sample, const Tensor3<> &F);

/// A registered law with its frame, whose theta is SomeDirection().
class SampledLaw
{
public:
   explicit SampledLaw(const LawSample &sample)
      : SampledLaw(sample.name, sample.values)
   {
   }
   SampledLaw(const std::string &name,
              const std::map<std::string, mfem::real_t> &values,
              const std::vector<const SolidLaw *> &parts = {});
   const SolidLaw &operator*() const { return *law; }
   const SolidLaw *operator->() const { return law.get(); }

private:
   CartesianFrame frame;
   std::unique_ptr<SolidLaw> law;
};

/// At AnyPoint; requires that the law has one.
Tensor3<> StressOf(const SolidLaw &law, const Tensor3<> &F,
                   Tangent3 *tangent = nullptr);

} // namespace synovia
