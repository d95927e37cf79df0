#include "synovia/io/log_definition.hpp"

namespace synovia
{

const std::vector<std::string> &LogData(LogSubject subject)
{
   static const std::vector<std::string> of_nodes{"x",  "y",  "z",  "ux", "uy",
                                                  "uz", "Rx", "Ry", "Rz", "p"};
   static const std::vector<std::string> of_elements{
      "x",   "y",   "z",   "sx",  "sy",  "sz",  "sxy", "syz", "sxz",
      "s1",  "s2",  "s3",  "Ex",  "Ey",  "Ez",  "Exy", "Eyz", "Exz",
      "E1",  "E2",  "E3",  "Fxx", "Fxy", "Fxz", "Fyx", "Fyy", "Fyz",
      "Fzx", "Fzy", "Fzz", "J",   "p",   "wx",  "wy",  "wz"};
   static const std::vector<std::string> of_bodies{"x",  "y",  "z",  "qx", "qy",
                                                   "qz", "qw", "Fx", "Fy", "Fz",
                                                   "Mx", "My", "Mz"};
   return subject == LogSubject::nodes      ? of_nodes
          : subject == LogSubject::elements ? of_elements
                                            : of_bodies;
}

} // namespace synovia
