#include "app/render/renderer.hpp"

#include <algorithm>
#include <app/render/background.hpp>
#include <app/render/body_mesh.hpp>
#include <app/render/fine_skin.hpp>
#include <app/render/ground_place.hpp>
#include <app/render/resources.hpp>
#include <app/render/section_cap.hpp>
#include <app/render/shadows.hpp>
#include <app/render/tool_drawing.hpp>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heml::render {
namespace {

const Vec3f key_direction = Vec3f(-0.50f, 0.78f, 0.38f).normalized();  // towards the lamp
constexpr float hatch_period = 11;                                     // pixels in a picture 720 high

// Uploads a colour map as a texture one pixel high. tissue.frag squares it: bytes are too coarse for dark linear
// colours.
void upload_map(const Texture& texture, Field field) {
  std::array<std::uint8_t, 3 * 256> pixels;
  for (int i = 0; i < 256; ++i) {
    const Vec3f colour = map_colour(field, static_cast<float>(i) / 255);
    for (int k = 0; k < 3; ++k)
      pixels[3 * i + k] = static_cast<std::uint8_t>(std::lround(255 * std::pow(colour[k], 1.1f)));
  }
  allocate_texture(texture, GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE, {256, 1});
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 256, 1, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
}

void upload_detail(const Texture& texture) {
  const std::string_view texels = resource("tissue.rgba");  // a square of make/tissue_texture.hpp
  const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(texels.size()) / 4)));
  allocate_texture(texture, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, {side, side});
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  // Two mipmap levels against aliasing; in smaller ones the folds of the octahedral map would show.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 2);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glGenerateMipmap(GL_TEXTURE_2D);
}

}  // namespace

class Renderer::Impl {
 public:
  Impl() { upload_detail(detail_); }
  void draw(const Frame& frame, const Camera& camera, const DrawOptions& options, Size size);

 private:
  void update_surface_mesh(const Frame& frame);
  void update_skin(const Frame& frame);
  const RenderTarget* canvas(const DrawOptions& options, Size size);
  void draw_picture(const ViewContext& shot, const Frame& frame, const DrawOptions& options,
                    const Background::Place& place);
  void update_section(const Frame& frame, const DrawOptions& options, const Range& range);
  void draw_body(const ViewContext& shot, const DrawOptions& options, bool shows_field);
  void draw_cap(const ViewContext& shot, bool shows_field);
  void draw_body_outline(const ViewContext& shot, bool shows_field);
  unsigned burns() const { return (shows_skin_ ? skin_->is_burnt() : body_->is_burnt()) ? as_burnt : 0u; }
  const Program& tissue_program(unsigned features);
  void prepare_body(const ViewContext& shot, const Program& program) const;
  void draw_casters(const Program& program) const;
  void draw_shadows(const ViewContext& shot, const Frame& frame, const DrawOptions& options);
  void draw_edges(const ViewContext& shot) const;
  void draw_constrained(const ViewContext& shot) const;
  Background::Ground ground(const ViewContext& shot, const Frame& frame, const DrawOptions& options) const;

  enum TissueFeature : unsigned {
    with_field = 1,
    with_hatching = 2,
    as_outline = 4,
    as_wound = 8,
    as_cap = 16,
    as_painted = 32,
    as_burnt = 64
  };
  std::array<std::optional<Program>, 128> tissue_;  // by features, compiled on first use
  Program line_{"line.vert", "line.frag"};
  Program bead_{"bead.vert", "bead.frag"};
  Background background_;
  Texture map_, detail_;
  std::optional<RenderTarget> canvas_;
  std::shared_ptr<const SurfaceMesh> surface_mesh_;  // the mesh of body_
  std::shared_ptr<const SurfaceMesh> whole_;         // the mesh of the uncut body
  TissueLooks looks_;
  TissueLook whole_look_, edited_look_;  // of the uncut body, and of body_ where it has edits
  std::optional<BodyMesh> body_;
  std::unique_ptr<FineSkin> skin_;  // in place of the body's surface; kept while that is shown
  bool shows_skin_ = false;
  std::shared_ptr<const SurfaceMesh> burnt_;  // the mesh whose burns skin_ has
  std::optional<SectionCap> cap_;             // made on first use
  Vec4f section_ = Vec4f::UnitW();            // the product with a point is negative beyond the section plane
  ShadowMap shadow_map_;
  Footprint footprint_;
  ToolDrawing tool_;
  GroundPlace ground_place_;
  bool has_shadows_ = false;  // of surface_mesh_, in both maps
};

const RenderTarget* Renderer::Impl::canvas(const DrawOptions& options, Size size) {
  const float scale = std::clamp(options.resolution, 0.25f, 1.0f);
  const Size wanted{std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(size.width)))),
                    std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(size.height))))};
  if (wanted == size) return nullptr;
  if (!canvas_ || !(canvas_->size() == wanted)) canvas_.emplace(wanted);
  return &*canvas_;
}

void Renderer::Impl::update_surface_mesh(const Frame& frame) {
  if (frame.surface_mesh == surface_mesh_) return;
  surface_mesh_ = frame.surface_mesh;
  has_shadows_ = false;
  body_.reset();
  if (!surface_mesh_) return;
  ground_place_ = GroundPlace(*surface_mesh_);
  const auto& whole = surface_mesh_->whole ? surface_mesh_->whole : surface_mesh_;
  if (whole != whole_) whole_look_ = looks_.of(whole);
  whole_ = whole;
  if (!surface_mesh_->whole) {
    body_.emplace(*surface_mesh_, whole_look_);
    return;
  }
  Wound wound(*surface_mesh_, bounding_sphere(whole->rest).radius);
  edited_look_ = tissue_look(whole_look_, wound.skin());
  body_.emplace(*surface_mesh_, edited_look_, std::move(wound));
}

void Renderer::Impl::update_skin(const Frame& frame) {
  shows_skin_ = body_ && body_->has_triangles() && frame.skin && frame.solid;
  if (!shows_skin_) return;
  if (frame.solid_positions.size() != frame.solid->rest.size())
    throw std::invalid_argument("Renderer::draw: the frame has another number of nodes than its solid");
  if (!skin_ || skin_->source() != frame.skin) {
    const std::unique_ptr<FineSkin> last = std::move(skin_);
    const TissueLook& look = surface_mesh_->whole ? edited_look_ : whole_look_;
    skin_ = std::make_unique<FineSkin>(frame.skin, *surface_mesh_, look, body_->rest(), last.get());
    burnt_ = nullptr;
  }
  if (std::exchange(burnt_, surface_mesh_) != surface_mesh_) skin_->set_burnt(surface_mesh_->burnt);
}

void Renderer::Impl::draw(const Frame& frame, const Camera& camera, const DrawOptions& options, Size size) {
  update_surface_mesh(frame);
  if (body_ && frame.positions.size() != body_->node_count())
    throw std::invalid_argument("Renderer::draw: the frame has another number of nodes than the surface mesh");
  if (body_ && !options.hatched.empty() && options.hatched.size() != body_->node_count())
    throw std::invalid_argument("Renderer::draw: `hatched` has another number of nodes than the surface mesh");
  update_skin(frame);
  const RenderTarget* scaled = canvas(options, size);
  const Size drawn = scaled ? scaled->size() : size;
  const Mat4f sight = camera.view(), projection = camera.projection(drawn);
  const ViewContext shot{
      camera, drawn, sight, projection, projection * sight, key_direction, body_ ? body_->rest().radius : 1};

  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_PROGRAM_POINT_SIZE);
  tool_.place(frame, options.hands, options.tool, shot);
  if (options.tool) tool_.place_stroke(options.stroke, shot);
  if (body_) {
    const Range range = options.range.value_or(natural_range(frame.field, frame.values));
    body_->update(frame, range);
    update_section(frame, options, range);
    if (shows_skin_) {
      skin_->update(frame, range, body_->placed());
      skin_->update_hatching(options.hatched);
      skin_->update_outline(camera.eye(), shot.view_projection, drawn);
    }
    if (!shows_skin_ || body_->has_wound()) {
      body_->update_hatching(options.hatched);
      body_->update_outline(camera.eye(), shot.view_projection, drawn);
    }
    if (!options.old_shadows || !has_shadows_) draw_shadows(shot, frame, options);
  }
  if (scaled) {
    scaled->bind();
    glViewport(0, 0, drawn.width, drawn.height);
  } else {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(options.left, options.bottom, drawn.width, drawn.height);
    glScissor(options.left, options.bottom, drawn.width, drawn.height);  // also clips wide points and lines
    glEnable(GL_SCISSOR_TEST);
  }
  draw_picture(shot, frame, options, scaled ? Background::Place{} : Background::Place{options.left, options.bottom});
  glDisable(GL_SCISSOR_TEST);
  if (scaled) scaled->stretch_to_screen(options.left, options.bottom, size);
}

void Renderer::Impl::draw_picture(const ViewContext& shot, const Frame& frame, const DrawOptions& options,
                                  const Background::Place& place) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  const Background::Ground ground = this->ground(shot, frame, options);
  background_.prepare(shot, ground, place);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (!ground.is_lowest) {  // what is below the ground is drawn over it: nothing hides the tissue
    background_.draw(shot, ground);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  const bool shows_field = frame.field != Field::none && body_ && frame.values.size() == body_->node_count();
  if (shows_field) upload_map(map_, frame.field);
  if (body_) {
    // Back faces show only where elements are inverted, and between a section's cap and the skin, which is smoothed.
    if (frame.min_J > 0 && !options.section) glEnable(GL_CULL_FACE);
    if (options.section) glEnable(GL_CLIP_DISTANCE0);
    draw_body(shot, options, shows_field);
    glDisable(GL_CULL_FACE);
    if (options.wireframe) draw_edges(shot);
    if (options.constrained) draw_constrained(shot);
    glDisable(GL_CLIP_DISTANCE0);
    if (options.section) draw_cap(shot, shows_field);
    tool_.draw(shot, shadow_map_);
  }
  if (ground.is_lowest) background_.draw(shot, ground);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  if (options.section) glEnable(GL_CLIP_DISTANCE0);
  if (body_) draw_body_outline(shot, shows_field);
  glDisable(GL_CLIP_DISTANCE0);
  tool_.draw_outline(shot);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
}

void Renderer::Impl::update_section(const Frame& frame, const DrawOptions& options, const Range& range) {
  section_ = Vec4f::UnitW();  // leaves out nothing: OSMesa still clips in the first picture without a plane
  if (!options.section) return;
  section_ << -options.section->normal, options.section->offset;
  if (!cap_) cap_.emplace();
  cap_->update(frame, *options.section, range, body_->rest());
}

void Renderer::Impl::draw_cap(const ViewContext& shot, bool shows_field) {
  // The cap lies in the plane itself, and OSMesa clips by the distance that a shader writes although clipping is off.
  const Vec4f plane = std::exchange(section_, Vec4f::UnitW());
  prepare_body(
      shot, tissue_program(as_wound | as_cap | (shows_field ? with_field : 0u) | (cap_->is_burnt() ? as_burnt : 0u)));
  cap_->draw();
  section_ = plane;
}

void Renderer::Impl::draw_body(const ViewContext& shot, const DrawOptions& options, bool shows_field) {
  const unsigned features = (shows_field ? with_field : 0u) | (options.hatched.empty() ? 0u : with_hatching) | burns();
  const auto prepare = [&](const Program& program) {
    prepare_body(shot, program);
    program.set("hatch_period", hatch_period * static_cast<float>(shot.size.height) / 720);
  };
  if (shows_skin_) {
    prepare(tissue_program(features | (skin_->is_painted() ? as_painted : 0u)));
    skin_->draw();
  } else {
    prepare(tissue_program(features));
    body_->draw_skin();
  }
  if (!body_->has_wound()) return;
  prepare(tissue_program(features | as_wound));
  body_->draw_wound();
}

void Renderer::Impl::draw_body_outline(const ViewContext& shot, bool shows_field) {
  const unsigned features = as_outline | (shows_field ? with_field : 0u) | burns();
  if (shows_skin_) {
    prepare_body(shot, tissue_program(features | (skin_->is_painted() ? as_painted : 0u)));
    skin_->draw_outline();
  } else {
    prepare_body(shot, tissue_program(features));
    body_->draw_skin_outline();
  }
  if (!body_->has_wound()) return;
  prepare_body(shot, tissue_program(features | as_wound));
  body_->draw_wound_outline();
}

/// A field is shown alike on skin and wounds, painted, burnt or not.
const Program& Renderer::Impl::tissue_program(unsigned features) {
  if (features & with_field) features &= ~(as_wound | as_painted | as_burnt);
  std::optional<Program>& program = tissue_[features];
  if (program) return *program;
  std::vector<const char*> defines;
  if (features & with_field) defines.push_back("FIELD");
  if (features & with_hatching) defines.push_back("HATCH");
  if (features & as_outline) defines.push_back("OUTLINE");
  if (features & as_wound) defines.push_back("WOUND");
  if (features & as_cap) defines.push_back("CAP");
  if (features & as_painted) defines.push_back("PAINTED");
  if (features & as_burnt) defines.push_back("BURNT");
  return program.emplace("tissue.vert", "tissue.frag", defines);
}

void Renderer::Impl::draw_shadows(const ViewContext& shot, const Frame& frame, const DrawOptions& options) {
  const BoundingSphere& rest = body_->rest();
  const auto casters = [&](const Program& program) { draw_casters(program); };
  shadow_map_.draw(bounding_sphere(frame.positions), key_direction, casters);
  if (options.ground) {
    const float ground = ground_place_.centre(frame, rest).y();
    footprint_.draw(rest.centre, rest.radius, ground, shot.key_direction, casters);
  }
  has_shadows_ = options.ground;
}

void Renderer::Impl::draw_casters(const Program& program) const {
  program.set("model", Mat4f(Mat4f::Identity()));
  if (shows_skin_) {
    skin_->draw();
    if (body_->has_wound()) body_->draw_wound();
  } else {
    body_->draw_flat();
  }
  tool_.cast(program);
}

void Renderer::Impl::prepare_body(const ViewContext& shot, const Program& program) const {
  program.use();
  program.set("view_projection", shot.view_projection);
  program.set("shadow_matrix", shadow_map_.matrix());
  program.set("eye", shot.camera.eye());
  program.set("section", section_);
  program.set("key_direction", shot.key_direction);
  // The rim light: behind the body as seen from the camera, high, on the side away from the key light.
  const Vec3f right = shot.camera.right(), up = shot.camera.up();
  program.set("tool_from", tool_.shade().from);
  program.set("tool_to", tool_.shade().to);
  program.set("tool_width", tool_.shade().width);
  program.set("rim_direction", Vec3f((0.75f * right + 0.55f * up - 0.6f * right.cross(up)).normalized()));
  const Vec3f lamp_right = shot.key_direction.cross(Vec3f::UnitZ()).normalized();
  program.set("lamp_right", lamp_right);
  program.set("lamp_up", Vec3f(lamp_right.cross(shot.key_direction)));
  const auto bind = [&](int unit, const char* name, const Texture& texture) {
    program.set(name, unit);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
  };
  if (shows_skin_ && skin_->is_painted()) bind(3, "paint", skin_->texture());
  bind(2, "shadow_map", shadow_map_.texture());
  bind(1, "colour_map", map_);
  bind(0, "detail_map", detail_);
}

void Renderer::Impl::draw_edges(const ViewContext& shot) const {
  line_.use();
  line_.set("view_projection", shot.view_projection);
  line_.set("section", section_);
  line_.set("tint", Vec4f(0.03f, 0.02f, 0.02f, 0.55f));
  glEnable(GL_LINE_SMOOTH);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  body_->draw_edges();
  glDisable(GL_BLEND);
  glDisable(GL_LINE_SMOOTH);
}

void Renderer::Impl::draw_constrained(const ViewContext& shot) const {
  bead_.use();
  bead_.set("view", shot.view);
  bead_.set("projection", shot.projection);
  bead_.set("bead_radius", body_->bead_radius());
  bead_.set("height", static_cast<float>(shot.size.height));
  bead_.set("key_direction", shot.key_direction);
  bead_.set("section", section_);
  bead_.set("tint", Vec3f(0.62f, 0.70f, 0.74f));
  body_->draw_constrained();
}

Background::Ground Renderer::Impl::ground(const ViewContext& shot, const Frame& frame,
                                          const DrawOptions& options) const {
  Background::Ground ground;
  if (body_) ground.centre = ground_place_.centre(frame, body_->rest());
  ground.radius = shot.radius;
  ground.footprint = footprint_.texture();
  ground.shown = body_ && options.ground && shot.camera.eye().y() > ground.centre.y();
  if (!ground.shown) return ground;
  std::vector<Eigen::AlignedBox3f> boxes = tool_.boxes();
  Eigen::AlignedBox3f& body = boxes.emplace_back();
  for (const Vec3f& x : frame.positions)
    if (x.allFinite()) body.extend(x);
  ground.is_lowest = !shows_skin_;  // a skin may be larger than the body
  for (const auto& box : boxes)
    ground.is_lowest = ground.is_lowest && (box.isEmpty() || box.min().y() > ground.centre.y());
  ground.shadowed = Footprint::reach(boxes, ground.centre, ground.radius, ground.centre.y(), shot.key_direction);
  return ground;
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;
void Renderer::draw(const Frame& frame, const Camera& camera, const DrawOptions& options, Size size) {
  impl_->draw(frame, camera, options, size);
}

}  // namespace heml::render
