//! Headless global illumination with virtual point lights (VPLs, instant radiosity) on any
//! wgpu adapter, software Vulkan included.
//!
//! # The pipeline
//!
//! Data flows one way:
//!
//! ```text
//! scene → bvh → visible points → VPLs → clusters → visibility → shading → image
//! ```
//!
//! 1. [`scene`] reads a scene file, a bare mesh or makes a built-in scene: triangles and
//!    spheres, materials and textures, lights and a camera, recentred and scaled before they
//!    become f32.
//! 2. [`bvh`] builds the bounding volume hierarchy that host and device both traverse.
//!    The triangles of a small scene are written into its shaders instead:
//!    [`render::kernels::literals`].
//! 3. [`render::Plan`] tells what programs a scene needs. With it, [`render::Prepared`] holds
//!    what is done once: hierarchy, lights, device ([`gpu::Gpu`]), kernels and the buffers of the
//!    scene. [`render::frame`] does the rest; `src/render.rs` lists its steps in their order, and
//!    each step lies in the room of `src/render/` that bears its name, its shaders in the folder
//!    of `shaders/` of the same name:
//! 4. **VPLs** (`vpls`): the host traces light paths; each hit deposits a virtual point light. Of
//!    many those are kept, by chance, that the image needs: rays from the camera's side tell which.
//! 5. **Visible points** (`camera`): camera rays, for each sample of every pixel of a tile; they go
//!    on at mirrors and glass. A few more rays of each pixel find what is thinner than a pixel, for
//!    which some visible points make room.
//! 6. **Direct light** (`direct`): shadow rays to a few point, spot and directional lights, and to
//!    samples of all other lights, which a guide of each block of pixels draws; glossy surfaces share
//!    these with rays by their lobes. Samples are combined over pixels of one surface, as far as they
//!    are noise. What stages have gathered at visible points
//!    (`gather`) becomes radiance once a kind of light.
//! 7. **Clusters** (`clusters`), in the methods that use them: [`cluster`] finds visible points, and
//!    VPLs, that may share visibility. Probes (a few shadow rays from every point) tell where a
//!    point sees otherwise than its cluster; such points are clustered anew.
//! 8. **Visibility** (`visibility`): a bit for each row (a visible point, or the representative of
//!    a cluster of them) and each VPL.
//! 9. **Shading** (`gather`): every visible point gathers every VPL that it sees; or one of s²
//!    subsets of them, which the pixels around it complete.
//!    The bound on near VPLs takes light away; bias compensation gives it back by short paths where
//!    the settings ask for that (`compensation`). `indirect` puts these together.
//! 10. **Antialiasing** (`camera`): a pixel's rays weigh the radiance of the visible points around;
//!     where surfaces of unlike radiance meet, more of them do.
//! 11. [`mod@image`] holds the result and writes PNG and EXR; [`report`] says what was done
//!     and how long it took; [`denoise`] renders frames and takes the noise of paths or of direct
//!     light away, where a library for it is installed; [`metrics`] says how far it is from a reference; [`study`] renders
//!     in many settings and compares; [`extremes`] holds the renderer against what must come out.
//!
//! One call of [`render::frame`] is one pass of the whole image with one seed; repeats and studies
//! are its callers, as whatever accumulates passes is.
//!
//! [`render::Method::Path`] goes another way, as a reference for this one: paths from the camera,
//! in `src/render/path.rs`, share scene, hierarchy and random numbers with it, but no light
//! transport; bias compensation alone borrows its stages.
//!
//! A *program* is an ordered list of the files in `shaders/`, chosen by what the scene and the
//! settings need ([`render::kernels`] makes them; `src/render/plan/programs.rs` is the one list of
//! which are needed). Compiled it is a *kernel*, with its buffers a *stage*, and one run of a stage
//! a *dispatch*. `shaders/README.md` tells what the folders hold.
//!
//! # The order of modules
//!
//! A file imports from its own module and from those before it, never in a circle; what it imports
//! by way of a re-export counts as from the file that defines it. `tests/modules` reads this list.
//!
//! ```text
//! message                one line of text, whatever a file is called
//! sampling               random numbers
//! gpu                    the device: buffers, records, kernels, dispatches
//! image                  images, their files, tone and false colours
//! metrics                how far an image is from another
//! scene                  scenes, the formats that they are read from
//! bvh                    the hierarchy that rays traverse
//! cluster                K-means
//! render::settings       what to render, and how well
//! render::features       what a scene has, and so what its shaders hold
//! render::result         what comes of a frame: image, counts, times
//! render::virtual_light  what points gather: VPLs, or places on light sources
//! render::materials      what rays hit on the host, and how light goes on there
//! render::lights         light sources as tables to draw from
//! render::kernels        which shader files make which program
//! render::plan           a scene without a device: what programs it needs
//! render::prepared       a scene on a device: what is done once
//! render::stage          a kernel with its buffers
//! render::clusters       clusters of visible points and of VPLs
//! render::vpls           light paths, what they leave, and which of it the image needs
//! render::camera         tiles, camera rays, the film
//! render::visibility     shadow rays between points and many lights
//! render::gather         light of many lights at visible points, combined over pixels
//! render::filter         noisy light, combined over pixels of one surface
//! render::direct         light straight from its source
//! render::path           the path tracer
//! render::compensation   what the bound on near VPLs took
//! render::indirect       gathering, interleaving and compensation together
//! render::frame          tiles and samples in their order
//! render::picture        the pictures that explain the method
//! render                 the steps of a frame in their order: read this first
//! denoise                frames without their noise, by a library where it is installed
//! error                  the union of all errors, and exit codes
//! report                 what was done, and what the user should know of it
//! study                  error over run time: plans, measurements, tables, plots, the page
//! extremes               cases at which renderers fail first, and checks of parts
//! cli                    the command line
//! ```
//!
//! # Example
//!
//! ```no_run
//! use gpu_vpl::gpu::{AdapterChoice, Gpu};
//! use gpu_vpl::render::{Prepared, Settings, frame};
//! use gpu_vpl::scene::Scene;
//!
//! let scene = Scene::load("builtin:cornell")?;
//! let camera = scene.camera;
//! let settings = Settings::default();
//! let prepared = Prepared::new(Gpu::open(&AdapterChoice::Auto)?, scene, &settings)?;
//! let result = frame(&prepared, &camera, &settings, 0, &|_, _| {})?;
//! println!("{} VPLs, {:?}", result.counts.vpls, result.phases.render());
//! # Ok::<(), gpu_vpl::error::Error>(())
//! ```
//!
//! # Units
//!
//! Linear Rec. 709 RGB, radiometric. Lengths are the scene file's; the renderer works in
//! normalised ones ([`scene::Units`]), and nothing that it reports depends on them.

pub mod bvh;
pub mod cli;
pub mod cluster;
pub mod denoise;
pub mod error;
pub mod extremes;
pub mod gpu;
pub mod image;
mod message;
pub mod metrics;
pub mod render;
pub mod report;
pub mod sampling;
pub mod scene;
pub mod study;
