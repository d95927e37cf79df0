#pragma once

#include "mfem.hpp"

#include <fstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace synovia
{

/// What one rank holds, for audits: numbers by name, and how much memory (MiB)
/// each part of a program has added to what the rank has in use.
class RankRecord
{
public:
   RankRecord() : in_use(MemoryInUse()) { Add("memory_at_start", in_use); }

   void Add(const std::string &name, double value)
   {
      values.emplace_back(name, value);
   }
   /// To be called when a part is finished.
   void AddMemoryOf(const std::string &part)
   {
      const double now = MemoryInUse();
      Add("memory_" + part, now - in_use);
      in_use = now;
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
   /// As Linux says it; 0 elsewhere.
   static double MemoryInUse()
   {
      std::ifstream statm("/proc/self/statm");
      double size = 0.0;
      double resident = 0.0;
      statm >> size >> resident;
      return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) /
             (1024.0 * 1024.0);
   }

   std::vector<std::pair<std::string, double>> values;
   double in_use;
};

} // namespace synovia
