#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_curves.hpp"
#include "synovia/feb/feb_guides.hpp"
#include "synovia/feb/feb_materials.hpp"
#include "synovia/feb/feb_mesh.hpp"
#include "synovia/feb/feb_steps.hpp"
#include "synovia/feb/feb_surfaces.hpp"

namespace synovia
{

/// A model as far as it has been read, while sections are added to its case.
struct FebModel
{
   /// solid or biphasic
   std::string module;
   FebMesh mesh;
   FebCurves curves;
   FebSteps steps;
   FebMaterials materials;
   std::vector<FebGuide> guides;
   /// Places of the parts of rigid bodies that others touch.
   std::set<int> touching;
   /// Borrows the mesh.
   std::unique_ptr<FebSurfaces> surfaces;
   CaseFile setup;
   /// Prescribed fluid pressures, with the nodes that have them.
   std::vector<std::pair<std::set<int>, LoadCurve>> pressures;
   /// Whether it is a step that is being read.
   bool in_step = false;
   /// Place of its first condition among those of the case.
   size_t first_condition = 0;
   /// Freedoms of rigid bodies, translations first, that this step prescribes
   /// relative to where the bodies are when it begins.
   std::map<std::string, std::array<bool, 6>> relative;

   /// The number in @a value, as a curve if it names a load controller.
   LoadCurve Value(const FebInput &value) const;
   /// That of the child of the name; 0, and @a from stops, if there is none.
   LoadCurve Value(const FebInput &from, const std::string &child) const;
   /// The rigid body of the case that @a word stands for, by the number or name
   /// of its material; null, and @a where stops, if there is none.
   RigidBodyCase *FindRigid(const std::string &word, const FebInput &where);
   /// Whether all nodes belong to rigid bodies that others touch.
   bool AreRigid(const std::vector<int> &nodes) const;
};

/// Add what a section of the file says to the case of the model.
void ReadBoundary(const FebInput &section, FebModel &model);
void ReadRigid(const FebInput &section, FebModel &model);
void ReadLoads(const FebInput &section, FebModel &model);
void ReadConstraints(const FebInput &section, FebModel &model);
void ReadContact(const FebInput &section, FebModel &model);
/// After the conditions and rigid bodies.
void ReadDiscrete(const FebInput &section, FebModel &model);

/// Adds the logs of the section Output to the case of the model, when the rest
/// has been read.
void ReadOutput(const FebInput &root, FebModel &model);

/// Reads the steps of a model without them: their time steps, of which those of
/// the model are made up.
void ReadStepTimes(const FebInput &root, FebModel &model);
/// Then what changes in each of them, when the rest has been read.
void ReadStepChanges(const FebInput &root, FebModel &model);

} // namespace synovia
