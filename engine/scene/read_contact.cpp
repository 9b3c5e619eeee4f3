#include "engine/scene/sections.hpp"

namespace repose {

namespace {

ContactParameters read_parameters(const CheckedCase& checked, const std::string& section) {
  return {.restitution = checked.number_or(section + "/restitution", 0.0),
          .static_friction = checked.number_or(section + "/static_friction", 0.0),
          .rolling_friction = checked.number_or(section + "/rolling_friction", 0.0)};
}

}  // namespace

ContactModel read_contact(const CheckedCase& checked) {
  ContactModel contact;
  contact.particle_particle = read_parameters(checked, "/contact/particle_particle");
  contact.particle_wall = read_parameters(checked, "/contact/particle_wall");
  contact.rolling_model = checked.choice_or("/contact/rolling_model", contact.rolling_model);
  contact.tangential_history = checked.choice_or("/contact/tangential_history", contact.tangential_history);
  contact.normal_damping = checked.choice_or("/contact/normal_damping", contact.normal_damping);
  contact.rolling_damping_ratio =
      checked.number_or("/contact/rolling_damping_ratio", contact.rolling_damping_ratio);
  contact.rolling_torque = checked.choice_or("/contact/rolling_torque", contact.rolling_torque);
  return contact;
}

}  // namespace repose
