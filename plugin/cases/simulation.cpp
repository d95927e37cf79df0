#include "cases/simulation.hpp"
#include "cases/line_output.hpp"
#include "cases/problem_report.hpp"
#include "general/error.hpp"
#include "general/text.hpp"
#include "general/version.hpp"
#include "io/output_directory.hpp"
#include "io/step_diagnostics.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
// Times closer than this part of a step are the same.
constexpr real_t same_part = 2e-6;

const CaseFile &Checked(const CaseFile &setup)
{
   CheckCase(setup);
   return setup;
}

NamedMesh ReadMesh(const CaseFile &setup, MPI_Comm comm)
{
   try
   {
      return ReadGmsh(setup.mesh.file, comm, setup.mesh.options);
   }
   catch (const Error &error) // on all ranks alike
   {
      throw Error(WhereIs(setup.places, "mesh.file") + ": " + error.what());
   }
}

bool IsRoot(MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   return rank == 0;
}

std::string VersionsText()
{
   std::string text;
   for (const auto &[name, version] : Versions())
   {
      text += (text.empty() ? "" : ", ") + name + " " + version;
   }
   return text;
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
   return text.str();
}
} // namespace

Simulation::Simulation(const CaseFile &setup_, MPI_Comm comm_)
   : setup(Checked(setup_)), comm(comm_), mesh(ReadMesh(setup, comm)),
     problem(setup, mesh)
{
   watch.Start();
}

Simulation::~Simulation() = default;

void Simulation::Describe(std::ostream &out)
{
   const ProblemReport report(setup, problem);
   const LineOutput reachable(setup, problem.Get());
   if (IsRoot(comm))
   {
      report.Write(out);
   }
}

TimeStepper &Simulation::Stepper()
{
   if (!stepper)
   {
      TimeOptions options(setup.time);
      for (const LineCase &line : setup.output.lines)
      {
         options.stops.insert(options.stops.end(), line.times.begin(),
                              line.times.end());
      }
      stepper = std::make_unique<TimeStepper>(problem.Get(), options);
   }
   return *stepper;
}

bool Simulation::IsNow(real_t time)
{
   return std::abs(time - Stepper().Time()) <= same_part * setup.time.step;
}

void Simulation::WriteSetup() const
{
   const std::string path = setup.output.directory + "/case.toml";
   std::string message;
   if (IsRoot(comm))
   {
      errno = 0;
      std::ofstream file(path, std::ios::trunc);
      file << "# As it ran, with all defaults: " << VersionsText() << "\n\n";
      WriteCase(setup, file);
      file.close();
      if (!file)
      {
         message = "cannot write '" + path + "': " + std::strerror(errno);
      }
   }
   ThrowIfAny(comm, message);
}

void Simulation::Start()
{
   if (log)
   {
      return;
   }
   // What may go wrong with files does so before the long work.
   const std::string &directory = setup.output.directory;
   MakeOutputDirectory(directory, comm);
   lines = std::make_unique<LineOutput>(setup, problem.Get());
   log = std::make_unique<RunLog>(directory, comm, false);
   WriteSetup();
   history = std::make_unique<History>(directory, comm);
   Stepper();
   if (setup.output.fields_every > 0)
   {
      fields =
         std::make_unique<FieldOutput>(directory, problem.Get(), *stepper);
   }
   progress = std::make_unique<Progress>(comm);

   BiphasicSpaces &spaces = problem.Get().Spaces();
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::ostringstream text;
   text << "order " << spaces.Order() << ", "
        << spaces.Displacement().GlobalTrueVSize() +
              spaces.Pressure().GlobalTrueVSize()
        << " dofs on " << ranks << (ranks == 1 ? " rank" : " ranks")
        << ", set up in " << std::setprecision(3) << watch.RealTime() << " s";
   log->Add(VersionsText());
   log->Add(text.str());
   if (IsRoot(comm))
   {
      std::cout << (setup.title.empty() ? "" : setup.title + "\n") << text.str()
                << std::endl;
   }
}

StepReport Simulation::Step()
{
   Start();
   const StepReport report = stepper->Step();
   if (!report.converged)
   {
      const std::string problem_text =
         "the step from t = " + ToText(report.time) +
         " with dt = " + ToText(report.dt) + " failed: " + report.reason;
      log->TryToAdd("error: " + problem_text);
      throw Error(problem_text);
   }
   const double before = watch.RealTime();
   Record(report);
   output_seconds += watch.RealTime() - before;
   progress->Report(report, *stepper);
   return report;
}

void Simulation::Record(const StepReport &report)
{
   history->Add(StepDiagnostics(problem.Get(), *stepper, report));
   const int every = setup.output.fields_every;
   if (fields && (stepper->Steps() % every == 0 || stepper->Done()))
   {
      fields->Save();
   }
   std::vector<size_t> due;
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      const std::vector<real_t> &times = setup.output.lines[i].times;
      bool now = times.empty() && stepper->Done();
      for (const real_t time : times)
      {
         now = now || IsNow(time);
      }
      if (now)
      {
         due.push_back(i);
      }
   }
   lines->Write(due, *stepper);
   log->Add(StepText(stepper->Steps(), report));
}

void Simulation::Run()
{
   Start();
   while (!Done())
   {
      Step();
   }
   Finish();
}

void Simulation::Finish()
{
   const PhaseTimes &phases = problem.Get().Operator().Times();
   std::ostringstream text;
   text << std::fixed << std::setprecision(1) << "total " << watch.RealTime()
        << " s: linear systems " << phases.linear << " s, contact search "
        << phases.search << " s, assembly " << phases.assembly << " s, output "
        << output_seconds << " s";
   log->Add(text.str());
   if (IsRoot(comm))
   {
      std::cout << text.str() << std::endl;
   }
}

} // namespace synovia
