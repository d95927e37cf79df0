#include "synovia/fem/tied_forces.hpp"
#include "synovia/fem/rotation_vector.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// The loads on a body at one time.
struct RigidLoad
{
   RigidLoad(const RigidBodyOptions &options, const RigidFrame &frame, real_t t)
   {
      for (int d = 0; d < 3; d++)
      {
         force[d] = options.load[d](t);
         moment[d] = options.load[d + 3](t);
      }
      if (options.load_follows)
      {
         force = frame.Turned(force);
         moment = frame.Turned(moment);
      }
   }

   Point3 force;
   Point3 moment;
};

DenseMatrix Product(const DenseMatrix &a, const DenseMatrix &b)
{
   DenseMatrix product(a.Height(), b.Width());
   Mult(a, b, product);
   return product;
}

// Adds y f^T - (y . f) I: what (w x y) x f is for a spin w.
void AddTurning(const Point3 &arm, const Point3 &force, DenseMatrix &turning)
{
   const real_t along = Dot(arm, force);
   for (int j = 0; j < 3; j++)
   {
      for (int i = 0; i < 3; i++)
      {
         turning(i, j) += arm[i] * force[j];
      }
      turning(j, j) -= along;
   }
}

// Of one body's 6 freedoms with respect to each other.
DenseMatrix StiffnessOf(const RigidBodyOptions &options,
                        const RigidFrame &frame, const RigidPose &pose,
                        const RigidLoad &load, const TiedForces &sum)
{
   DenseMatrix moments(sum.turning);
   DenseMatrix forces(3);
   forces = 0.0;
   if (options.load_follows)
   {
      moments.Add(-1.0, CrossMatrix(load.moment));
      forces.Add(-1.0, CrossMatrix(load.force));
   }
   DenseMatrix spin_transpose(frame.Spin());
   spin_transpose.Transpose();
   DenseMatrix turning =
      Product(spin_transpose, Product(moments, frame.Spin()));
   turning += SpinTransposeDerivative(RotationOf(pose),
                                      Sum(sum.moment, 1.0, load.moment));
   const DenseMatrix moving = Product(forces, frame.Spin());
   DenseMatrix stiffness(6);
   stiffness = 0.0;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         stiffness(i, j + 3) = -moving(i, j);
         stiffness(i + 3, j + 3) = -turning(i, j);
      }
   }
   return stiffness;
}
} // namespace

void TiedForces::Add(const Point3 &arm, const Point3 &added, bool finite)
{
   force = Sum(force, 1.0, added);
   moment = Sum(moment, 1.0, Cross(arm, added));
   if (finite)
   {
      AddTurning(arm, added, turning);
   }
}

std::vector<TiedForces> SumForces(const RigidTies &ties,
                                  const RigidPoses &poses, const Vector &forces)
{
   constexpr int size = 3 + 3 + 9;
   forces.HostRead();
   Vector all(size * ties.Bodies());
   all = 0.0;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      const RigidFrame frame = ties.Frame(b, poses);
      real_t *sum = all.GetData() + size * b;
      DenseMatrix turning(sum + 6, 3, 3);
      for (const TiedNodes::Node &node : ties.Nodes(b).Get())
      {
         const Point3 force{
            {forces[node.dof], forces[node.dof + 1], forces[node.dof + 2]}};
         const Point3 arm = frame.Turned(node.arm);
         const Point3 moment = Cross(arm, force);
         for (int d = 0; d < 3; d++)
         {
            sum[d] += force[d];
            sum[d + 3] += moment[d];
         }
         if (ties.IsFinite())
         {
            AddTurning(arm, force, turning);
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, all.GetData(), all.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, ties.GetComm());
   std::vector<TiedForces> sums;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      real_t *sum = all.GetData() + size * b;
      sums.push_back({{{sum[0], sum[1], sum[2]}},
                      {{sum[3], sum[4], sum[5]}},
                      DenseMatrix(3)});
      sums.back().turning = sum + 6;
   }
   return sums;
}

Vector FreedomForces(const RigidTies &ties, const RigidPoses &poses, real_t t,
                     const std::vector<TiedForces> &sums)
{
   Vector forces(static_cast<int>(ties.Slots().size()));
   for (int k = 0; k < forces.Size(); k++)
   {
      const RigidTies::Slot &slot = ties.Slots()[k];
      if (!ties.IsFreedom(slot))
      {
         forces[k] = 0.0;
         continue;
      }
      const RigidBodyOptions &options = ties.Options(slot.body);
      const RigidFrame frame = ties.Frame(slot.body, poses);
      const RigidLoad load(options, frame, t);
      const TiedForces &sum = sums[slot.body];
      const real_t on_freedom =
         slot.freedom < 3
            ? sum.force[slot.freedom] + load.force[slot.freedom]
            : TransposeTimes(frame.Spin(), Sum(sum.moment, 1.0,
                                               load.moment))[slot.freedom - 3];
      forces[k] = slot.scale * (on_freedom - options.stiffness[slot.freedom] *
                                                poses[slot.body][slot.freedom]);
   }
   return forces;
}

DenseMatrix FreedomStiffness(const RigidTies &ties, const RigidPoses &poses,
                             real_t t, const std::vector<TiedForces> &sums)
{
   const std::vector<RigidTies::Slot> &slots = ties.Slots();
   const int size = static_cast<int>(slots.size());
   DenseMatrix all(size);
   all = 0.0;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      const RigidBodyOptions &options = ties.Options(b);
      DenseMatrix stiffness(6);
      stiffness = 0.0;
      if (ties.IsFinite())
      {
         const RigidFrame frame = ties.Frame(b, poses);
         stiffness = StiffnessOf(options, frame, poses[b],
                                 RigidLoad(options, frame, t), sums[b]);
      }
      for (int i = 0; i < 6; i++)
      {
         stiffness(i, i) += options.stiffness[i];
      }
      for (int j = 0; j < size; j++)
      {
         for (int i = 0; i < size; i++)
         {
            if (slots[i].body == b && slots[j].body == b)
            {
               all(i, j) = slots[i].scale * slots[j].scale *
                           stiffness(slots[i].freedom, slots[j].freedom);
            }
         }
      }
   }
   return all;
}

} // namespace synovia
