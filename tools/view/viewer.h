#pragma once
// The loop behind viewEffect(): what is loaded, what is drawn, what the window shows.

#include "host/gpu/present.h"
#include "tools/view/beside.h"
#include "tools/view/canvas.h"
#include "tools/view/mesh_canvas.h"
#include "tools/view/overlay.h"
#include "tools/view/panel.h"
#include "tools/view/picture_area.h"
#include "tools/view/reading.h"
#include "tools/view/source_text.h"
#include "tools/view/state.h"
#include "tools/view/targets.h"
#include "tools/view/unfold.h"
#include "tools/view/view.h"
#include "tools/view/watch.h"

#include <chrono>
#include <deque>
#include <future>
#include <set>

namespace tegument::view {

/// While the text settles.
inline constexpr int kSettlingFrames = 3;

class Viewer {
public:
    static Result<std::unique_ptr<Viewer>> start(const ViewRequest& request, const std::function<void(const std::string&)>& say);
    /// Returns when the window is closed.
    [[nodiscard]] Result<void> run();
    /// The steps one after another, each as soon as the one before has its picture.
    [[nodiscard]] Result<std::vector<Reaction>> replay(const std::vector<ReplayStep>& steps);
    [[nodiscard]] std::vector<std::string> validationMessages() const { return device_.validationMessages(); }
    /// Other threads still work, and destruction would wait for them.
    [[nodiscard]] bool isBusy() const;

private:
    /// Until what a move needs is there.
    [[nodiscard]] Result<void> awaitReady(std::vector<Reaction>& reactions);
    /// Until the picture that a step asked for is there. `next`: drags it has meanwhile.
    [[nodiscard]] Result<void> awaitMade(const ReplayStep& next, std::size_t before, std::vector<Reaction>& reactions);
    /// Until a small picture is whole, which is a step of its own kind.
    [[nodiscard]] Result<void> awaitSharp(std::vector<Reaction>& reactions);

    Viewer(const ViewRequest& request, const std::function<void(const std::string&)>& say, std::optional<Window> window,
           gpu::Device device);
    [[nodiscard]] Result<void> prepare();

    /// What a window has heard, and the picture of it.
    [[nodiscard]] Result<void> step(const Input& input);
    [[nodiscard]] Input wait();
    [[nodiscard]] Result<void> obey(const Input& input);
    [[nodiscard]] Result<void> obey(Command command);
    [[nodiscard]] Result<void> fulfil(Request request);
    [[nodiscard]] Result<void> resize();

    /// Whether files have changed, and may not be whole yet.
    [[nodiscard]] bool saving();
    /// Whether files have changed, and have been still for a moment.
    [[nodiscard]] bool edited();
    [[nodiscard]] Result<std::shared_ptr<const Adoption>> readSource() const;
    /// Camera, light, parameters, technique and setting as the request has them.
    void begin();
    void readPresets();
    [[nodiscard]] Result<SessionFrame> drawWith(Loaded& loaded);
    /// The frame's shown target becomes the picture.
    [[nodiscard]] Result<void> develop(SessionFrame frame);
    [[nodiscard]] Result<void> findLevels(gpu::Texture& texture, const std::string& name);
    [[nodiscard]] Result<void> paint();
    /// A target of the picture's size.
    [[nodiscard]] Result<void> makePicture(gpu::Texture& picture, const char* name);
    [[nodiscard]] Levels shownLevels() const;
    /// Of the last frame, flat: faces of a cube side by side. Null: there is none of that name.
    [[nodiscard]] Result<gpu::Texture*> shownTexture();

    // viewer_making.cpp
    /// Reads the effect and draws it, in pieces; until then, or if either fails, what was there before stays. `anew`: its textures, too.
    void load(std::string what, bool anew = false);
    /// The next technique, setting...
    void makeAnother(Command command);
    void makeWanted(const Wanted& wanted);
    void make(Making making);
    void dropMaking();
    [[nodiscard]] ToRead toRead(const ViewRequest& request, const Wanted& wanted);
    /// The next piece of what is made. `rests`: nobody asks for anything else.
    [[nodiscard]] Result<void> advance(bool rests);
    [[nodiscard]] Result<void> takeReading();
    [[nodiscard]] Result<void> drawMaking();
    [[nodiscard]] Result<void> finishMaking(SessionFrame frame);
    [[nodiscard]] Result<void> failMaking(const Error& error);
    /// "technique Lambert, shader 3 of 19"; empty: nothing is made.
    [[nodiscard]] std::string makingText() const;
    /// What is drawn first of a picture whose costs are those of the one before.
    [[nodiscard]] Sharpness soon() const;

    // viewer_open.cpp
    /// The next of the files that were dropped on the window, once nothing else is made.
    void openDropped();
    [[nodiscard]] Result<void> takeOpened();
    /// The picture of it is there.
    void showOpened(ViewRequest request);
    /// What is drawn of it: as it has it, or as it was turned and set.
    void lookAt(Making& making) const;

    // viewer_mesh.cpp
    /// What false colours need is there; begins to make it.
    [[nodiscard]] bool haveMeshes();
    void dropMeshes();
    /// The mesh in false colours instead of the picture.
    [[nodiscard]] Result<void> paintMesh();
    /// Texels along each side of the largest map that does not follow the picture's size.
    [[nodiscard]] std::uint32_t mapSide();
    void describeMesh(PanelPictures& pictures);
    /// The texture of roots that the frame samples; empty: none.
    [[nodiscard]] std::string rootsTexture() const;
    [[nodiscard]] Result<void> countFur();
    /// What a click in the list of textures asks for.
    [[nodiscard]] Result<void> bakeAgain(const std::string& name);

    // viewer_moving.cpp
    [[nodiscard]] Result<void> draw();
    /// Small and coarse where a whole picture takes too long. `what` moves: each has passes of its own that must be drawn.
    /// `learns`: what it takes tells what the next will take.
    [[nodiscard]] Result<void> drawMoving(Moving what, bool learns = true);
    [[nodiscard]] Result<void> drawAs(const Sharpness& how);
    [[nodiscard]] bool isDraft() const { return !sharpness_.whole(); }
    /// Of what is shown.
    [[nodiscard]] EffectSession& session() { return (sharpness_.drafting ? draft_ : loaded_)->session; }
    /// Of a whole picture.
    void noteCosts();
    /// What the last frame's passes took, of both sides.
    [[nodiscard]] PassCosts passCosts();
    [[nodiscard]] PassCosts costsOf(const SessionFrame& frame, EffectSession& of) const;
    /// Another pass or target is to be shown: what was shown before stays until it is drawn, piece by piece.
    [[nodiscard]] Result<void> drawSoon();
    /// Draws the whole picture once nothing moves, piece by piece; given up where something moves again.
    [[nodiscard]] Result<void> sharpen();
    /// The window's or the replay's: whether a picture in pieces is to be finished.
    [[nodiscard]] bool mayGoOn();
    void notePiece();
    [[nodiscard]] PixelSize drawnPixels() const;
    /// Of the picture as the canvas has it before it stands in the window.
    [[nodiscard]] PixelSize paintedPixels() const;
    [[nodiscard]] Canvas::Fit fitOf(const gpu::Texture& texture) const;
    [[nodiscard]] Closer closer() const;

    // viewer_draft.cpp
    /// Once the window rests: what a move will need. A little at a time.
    [[nodiscard]] Result<void> prepareToMove();
    [[nodiscard]] bool preparing() const;
    [[nodiscard]] bool wantsDraft() const;
    /// Draws small pictures of each side that nobody sees: what a device makes for its first one is then there, and which passes a move of
    /// the camera draws, and what they take, is known. True: both sides are done.
    [[nodiscard]] bool rehearse();
    /// Of one side. None: it was given up.
    [[nodiscard]] std::optional<RehearsalCosts> rehearse(Loaded& side, const std::string& technique,
                                                         const std::map<std::string, std::vector<double>>& parameters);
    void rehearseDraftBeside();
    /// Meshes in fewer triangles, made by another thread; takes them once they are there.
    void takeFewer();
    /// Begins to read the effect with fewer texels in the maps that do not follow the picture's size, where it has such.
    void readDraft();
    /// A session of that, if it does ask how many they are (TEGUMENT_MAP_SIZE), has drawn a frame. It may take several calls.
    [[nodiscard]] bool haveDraft(bool inPieces);
    [[nodiscard]] Result<SessionFrame> drawDraft(bool inPieces);
    /// The kept side moves as fast as the picture, where it is of the same effect.
    void shareDraft();
    void dropDraft();
    void dropFewer();

    // viewer_beside.cpp
    [[nodiscard]] Result<void> keep();
    [[nodiscard]] Result<void> openBeside(const std::filesystem::path& file);
    [[nodiscard]] Result<void> drawBeside();
    /// The kept side as the picture is drawn.
    [[nodiscard]] Result<SessionFrame> drawSide();
    [[nodiscard]] Result<void> paintBeside();
    /// The picture's values and those beside it, in the same kind of light.
    [[nodiscard]] Result<std::pair<Image, const Image*>> sides();
    /// The values of both there, and how far apart they are.
    [[nodiscard]] std::vector<std::string> probedBeside(const std::string& shown, glm::dvec2 place);
    [[nodiscard]] Result<void> measureBeside();
    void forgetError();
    [[nodiscard]] Result<void> findErrors();
    /// Picture, what is beside it, or the errors, without text.
    [[nodiscard]] Result<void> compose();
    [[nodiscard]] std::optional<BesideText> besideText() const;
    [[nodiscard]] std::string sideName() const;
    /// Where the mouse can take it: share of the window.
    [[nodiscard]] std::optional<double> borderOfWindow() const;

    /// What the window is divided into, as what is shown asks for.
    void arrangePanels();
    /// Picture and text on the window.
    [[nodiscard]] Result<void> show();
    [[nodiscard]] Result<void> composeWithText(PanelOutcome& outcome);
    /// What was done in the panels.
    [[nodiscard]] Result<void> follow(const PanelOutcome& outcome);
    /// To a name of its own where none is given.
    void save(std::filesystem::path path = {});
    /// The file's path; none when it cannot be written, which is then said.
    std::optional<std::filesystem::path> saveWorkspace(std::filesystem::path path = {});
    void copyCommand();
    void notice(std::string text);
    [[nodiscard]] Result<void> bind(const BindingChoice& choice);

    [[nodiscard]] RunOptions runOptions() { return runOptionsOf(request_); }
    [[nodiscard]] RunOptions runOptionsOf(const ViewRequest& request);
    /// How the values of what is shown are spread: the last that is known, while another thread counts.
    [[nodiscard]] std::optional<Histogram> histogram(const std::string& shown);
    [[nodiscard]] Result<Image> shownValues(const std::string& shown);
    /// What the panels show of the targets: read back and made small only while it is asked for.
    [[nodiscard]] Result<PanelPictures> panelPictures();
    [[nodiscard]] std::vector<std::string> probed();
    /// None: there is no such target.
    [[nodiscard]] std::optional<ProbedTexel> probe(EffectSession& from, const std::string& name, int level, glm::dvec2 place);
    [[nodiscard]] PanelText panelText();
    [[nodiscard]] std::string statusText() const;
    [[nodiscard]] std::string titleText() const;
    /// The sources of the picture; with an error also what it points at, and their folders, where a missing file may appear.
    void watchFiles(const Effect* effect, const Error* error);
    /// Shows and says why there is no new picture. Hands the error on when the device is lost.
    [[nodiscard]] Result<void> report(const Effect* effect, const Error& error);

    ViewRequest request_;
    const std::function<void(const std::string&)>& say_;
    std::optional<Window> window_; // none: a replay
    gpu::Device device_;
    std::optional<gpu::Presenter> presenter_;
    std::optional<Canvas> canvas_;
    std::optional<Overlay> overlay_;
    std::unique_ptr<Loaded> loaded_;
    std::unique_ptr<Beside> beside_;
    std::size_t besideViews_ = 0;        // pictures that there were to compare
    std::future<std::string> measuring_; // the error
    std::size_t measuredView_ = 0;       // of which
    std::optional<Histogram> histogram_; // the last one
    std::future<Histogram> histogramMaking_;
    std::string histogramOf_; // what that is of
    std::size_t frames_ = 0;  // that were shown
    SourceText source_;
    FileWatch watch_;
    ViewState state_;
    ViewState start_;

    SessionFrame frame_;   // the last good one
    ShownTargets targets_; // of the last good one
    PassTimes times_;
    std::vector<ColoredMesh> meshes_; // while they are shown
    std::future<std::vector<ColoredMesh>> meshesMaking_;
    std::vector<std::future<std::vector<ColoredMesh>>> meshesAbandoned_;
    std::unique_ptr<MeshCanvas> meshCanvas_;
    MeshShow meshShown_ = MeshShow::None;
    glm::dvec2 cursor_{-1}; // share of the window
    gpu::Texture picture_;  // as it is shown, without text
    gpu::Texture unfolded_; // faces of a cube
    std::uint64_t unfoldedFrom_ = 0;
    gpu::Texture composed_; // with text, of the window's size
    Levels levels_;         // of what is shown
    std::string levelled_;  // what they were found for
    PixelSize size_;        // of what is drawn
    PictureArea area_;      // of the window, that is the picture's
    PanelMemory panels_;
    std::vector<char32_t> waitingKeys_; // that came with a click
    double milliseconds_ = 0;           // from asking for the frame to having it
    std::string problem_;
    std::string notice_;
    std::filesystem::path workspaceFile_; // the last one written
    std::string workspaceText_;
    std::string title_;
    Sharpness sharpness_; // of what is shown
    MovingCosts costs_;
    std::unique_ptr<Loaded> draft_;
    MovingCosts draftCosts_;
    std::shared_ptr<const FewerTriangles> fewer_;
    std::future<FewerTriangles> fewerMaking_;
    std::vector<std::future<FewerTriangles>> fewerAbandoned_; // of scenes that are gone
    std::unique_ptr<Reading> draftReading_;
    Wanted wanted_;
    std::unique_ptr<Making> making_;
    std::deque<Opening> dropped_;                                     // that wait
    std::vector<std::unique_ptr<Reading>> abandoned_;                 // until their threads have ended
    std::string madeText_;                                            // as it is shown
    std::chrono::steady_clock::time_point told_;                      // when that was
    std::size_t made_ = 0;                                            // pictures, or errors in their place
    std::optional<std::chrono::steady_clock::time_point> firstSaved_; // files that changed and may not be whole yet
    std::chrono::steady_clock::time_point lastSaved_;
    PieceTimes pieces_;
    std::chrono::steady_clock::time_point pieceBegan_;
    double longestPiece_ = 0;                     // milliseconds in which the viewer did not answer
    bool interrupted_ = false;                    // of a replay: while a drag goes on, each piece is the last for now
    bool broken_ = false;                         // what was asked for last has no picture
    std::chrono::steady_clock::time_point moved_; // when the last picture was there
    int settling_ = 0;                            // Dear ImGui's layout follows its input by a frame or two
    std::set<std::string> warned_;
    bool rehearsed_ = false;
    bool draftTried_ = false; // there is one, or none can be
    bool draftDrawn_ = false;
    bool fewerAsked_ = false;
    bool inPieces_ = false; // what is drawn now
    bool stale_ = false;    // what is to be shown is not drawn yet
    bool torn_ = false;     // targets of what is shown hold parts of a picture that was given up
    bool running_ = true;
};

} // namespace tegument::view
