#include "support/gmsh_meshes.hpp"

#include "synovia/general/error.hpp"

#include <fstream>
#include <sstream>

namespace synovia
{

namespace
{
std::string PathOf(const std::string &model, const GmshFormat &format,
                   const std::string &extension)
{
   std::ostringstream path;
   path << SYNOVIA_GMSH_MESHES "/" << model << ".v" << format.version
        << (format.binary ? ".binary" : ".text") << ".order" << format.order
        << (format.serendipity ? ".serendipity" : "") << extension;
   if (!std::ifstream(path.str()).good())
   {
      throw Error("there is no \"" + path.str() +
                  "\": the test gmsh_meshes makes the files that "
                  "tests/support/gmsh_models.py lists");
   }
   return path.str();
}
} // namespace

std::string GmshMesh(const std::string &model, const GmshFormat &format)
{
   return PathOf(model, format, ".msh");
}

std::vector<GmshPoint> GmshPoints(const std::string &model,
                                  const GmshFormat &format)
{
   std::ifstream stream(PathOf(model, format, ".points"));
   std::vector<GmshPoint> points;
   GmshPoint point;
   while (stream >> point.element >> point.place[0] >> point.place[1] >>
          point.place[2])
   {
      points.push_back(point);
   }
   return points;
}

} // namespace synovia
