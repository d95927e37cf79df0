#include "synovia/runs/run_texts.hpp"
#include "synovia/general/text.hpp"

#include <iomanip>
#include <sstream>

namespace synovia
{

std::string SizeText(BiphasicSpaces &spaces, double seconds)
{
   int ranks = 1;
   MPI_Comm_size(spaces.GetComm(), &ranks);
   std::ostringstream text;
   text << "order " << spaces.Order() << ", "
        << spaces.Displacement().GlobalTrueVSize() +
              spaces.Pressure().GlobalTrueVSize()
        << " dofs on " << ranks << (ranks == 1 ? " rank" : " ranks")
        << ", set up in " << std::setprecision(3) << seconds << " s";
   return text.str();
}

std::string BeginText(const CaseOfStep &step)
{
   return "step \"" + step.name + "\": from t = " + ToText(step.begin) +
          " to " + ToText(step.end);
}

std::string JumpText(mfem::real_t jump)
{
   return "displacements that this step prescribes begin up to " +
          ToText(jump) +
          " from where the surfaces are, and jump in the first time step; a "
          "curve that begins there, or relative = true, avoids that";
}

std::string PlaceText(const StrainExtreme &extreme)
{
   return "in region \"" + extreme.region + "\" at (" +
          ToText(extreme.place[0]) + ", " + ToText(extreme.place[1]) + ", " +
          ToText(extreme.place[2]) + ")";
}

std::string StepText(int step, const StepReport &report)
{
   std::ostringstream text;
   text << "step " << step << "  t " << std::setprecision(10) << report.time
        << "  dt " << std::setprecision(6) << report.dt << "  newton "
        << report.solve.newton << "  augmentations "
        << report.solve.augmentations << "  linear " << report.solve.linear
        << "  area " << report.contact_area << "  seconds "
        << std::setprecision(3) << report.seconds;
   if (report.failures + report.rejections > 0)
   {
      text << "  failed tries " << report.failures << ", inaccurate "
           << report.rejections;
   }
   if (report.failures > 0)
   {
      text << "; last: " << report.last_failure;
   }
   return text.str();
}

std::string PhaseText(const PhaseTimes &phases, double total, double output)
{
   std::ostringstream text;
   text << std::fixed << std::setprecision(1) << "total " << total
        << " s: linear systems " << phases.linear << " s, their set-up "
        << phases.setup << " s, contact search " << phases.search
        << " s, assembly " << phases.assembly << " s, output " << output
        << " s";
   return text.str();
}

} // namespace synovia
