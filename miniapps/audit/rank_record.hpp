#pragma once

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// What one rank holds, for audits: numbers by name, and how much memory (MiB)
/// each part of a program has added to what the rank has in use.
///
/// Memory is the rank's own. What MPI shares between the ranks of a machine is
/// a number apart: it grows with the ranks of one machine, not with those of a
/// run, and each of them counts it whole. Programs and libraries, which the
/// system shares as well, aren't counted.
class RankRecord
{
public:
   RankRecord() : in_use(MemoryInUse().own) { Add("memory_at_start", in_use); }

   void Add(const std::string &name, double value)
   {
      values.emplace_back(name, value);
   }
   /// To be called when a part is finished.
   void AddMemoryOf(const std::string &part)
   {
      const Memory now = MemoryInUse();
      Add("memory_" + part, now.own - in_use);
      in_use = now.own;
      // What is shared only grows.
      peak = std::max(peak, now.peak_of_all - now.shared - now.files);
   }
   /// Adds the peak of the parts so far, and what is shared.
   void AddMemoryOfAll()
   {
      Add("memory_peak", peak);
      Add("memory_shared", MemoryInUse().shared);
   }
   /// Two lines: names and values.
   void Write(const std::string &file) const
   {
      std::ofstream out(file);
      for (std::size_t i = 0; i < values.size(); i++)
      {
         out << (i > 0 ? "," : "") << values[i].first;
      }
      out << '\n';
      for (std::size_t i = 0; i < values.size(); i++)
      {
         out << (i > 0 ? "," : "") << values[i].second;
      }
      out << '\n';
   }

private:
   /// Resident memory (MiB).
   struct Memory
   {
      double own = 0.0;
      double shared = 0.0;
      double files = 0.0;
      double peak_of_all = 0.0;
   };

   /// As Linux says it; 0 elsewhere.
   static Memory MemoryInUse()
   {
      Memory memory;
      std::ifstream status("/proc/self/status");
      std::string name;
      while (status >> name)
      {
         double kilobytes = 0.0;
         double *const number = name == "RssAnon:"    ? &memory.own
                                : name == "RssShmem:" ? &memory.shared
                                : name == "RssFile:"  ? &memory.files
                                : name == "VmHWM:"    ? &memory.peak_of_all
                                                      : nullptr;
         if (number && status >> kilobytes)
         {
            *number = kilobytes / 1024.0;
         }
         status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
      }
      return memory;
   }

   std::vector<std::pair<std::string, double>> values;
   double in_use;
   double peak = 0.0;
};

} // namespace synovia
