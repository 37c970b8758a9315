//! Arranges the parts of a sheet: measures a few arrangements common in textbooks and takes the one
//! that fills a page best.

mod columns;

use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::Point;

use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::{FigureItem, Shape};
use hodograph_paper::paper::style::Style;

/// The parts of a sheet.
pub(super) struct SheetPieces {
    /// The title.
    pub title: Option<DrawingPart>,
    /// Mechanism and polygons, with their captions.
    pub drawings: Vec<DrawingPart>,
    /// The heading and the equations of each polygon.
    pub equations: Vec<(DrawingPart, Vec<DrawingPart>)>,
    /// The results.
    pub results: DrawingPart,
    /// For each group of forces: the separated links, the force polygon and the text.
    pub forces: Vec<[DrawingPart; 3]>,
}

impl SheetPieces {
    /// In a figure of a series, gives each part the space of the figures before.
    pub fn held(mut self, style: &Style) -> SheetPieces {
        let Some(memory) = &style.memory else { return self };
        let equations = self
            .equations
            .iter_mut()
            .flat_map(|(heading, lines)| std::iter::once(heading).chain(lines));
        let all = self.title.iter_mut().chain(&mut self.drawings).chain(equations);
        let all = all.chain([&mut self.results]).chain(self.forces.iter_mut().flatten());
        all.for_each(|part| memory.hold("sheet", part));
        self
    }
}

/// Gap between drawings, and between drawings and text.
const GAP_MM: f64 = 10.0;
/// Gap between equations.
const LINE_GAP_MM: f64 = 2.4;
/// Extra space above a heading in the middle of a column.
const HEADING_AIR_MM: f64 = 3.0;
/// Size of A4 landscape, the target for sheets.
pub(super) const AIM_MM: [f64; 2] = [297.0, 210.0];
/// Weight of the empty part of a page against the relative size of the sheet.
const EMPTY_COST: f64 = 0.35;
/// A larger sheet, relative to A4, has type that is hard to read in print: it is set in its smallest
/// arrangement, also in columns.
const CROWDED: f64 = 1.55;

/// The direction in which the children of a box are placed.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum BoxDirection {
    Row,
    Column,
}

/// A tree of boxes; the leaves are indices of parts.
#[derive(Clone)]
pub(super) enum Tree {
    Leaf(usize),
    /// Vertical space in a column (mm).
    Air(f64),
    Group {
        along: BoxDirection,
        gap_mm: f64,
        children: Vec<Tree>,
        centred: bool,
    },
}

impl Tree {
    pub fn row(children: Vec<Tree>) -> Tree {
        Tree::Group { along: BoxDirection::Row, gap_mm: GAP_MM, children, centred: true }
    }

    pub fn text_row(children: Vec<Tree>) -> Tree {
        Tree::Group { along: BoxDirection::Row, gap_mm: GAP_MM, children, centred: false }
    }

    pub fn column(children: Vec<Tree>) -> Tree {
        Tree::Group { along: BoxDirection::Column, gap_mm: GAP_MM, children, centred: true }
    }

    pub fn text_column(children: Vec<Tree>) -> Tree {
        Tree::Group { along: BoxDirection::Column, gap_mm: LINE_GAP_MM, children, centred: false }
    }

    /// Returns width and height (mm).
    pub fn size(&self, parts: &[DrawingPart]) -> [f64; 2] {
        match self {
            Tree::Leaf(k) => [parts[*k].bounds.width_mm(), parts[*k].bounds.height_mm()],
            Tree::Air(mm) => [0.0, *mm],
            Tree::Group { along, gap_mm, children, .. } => {
                let sizes: Vec<[f64; 2]> =
                    children.iter().map(|c| c.size(parts)).filter(|s| s[1] > 0.0).collect();
                let gaps = gap_mm * sizes.len().saturating_sub(1) as f64;
                let sum = |k: usize| sizes.iter().map(|s| s[k]).sum::<f64>();
                let max = |k: usize| sizes.iter().map(|s| s[k]).fold(0.0, f64::max);
                match along {
                    BoxDirection::Row => {
                        let [above, below] = self.captions_mm(parts);
                        [sum(0) + gaps, max(1).max(above + below)]
                    }
                    BoxDirection::Column => [max(0), sum(1) + gaps],
                }
            }
        }
    }

    /// The greatest heights above and below the captions of drawings side by side, which are on one
    /// line; zero if the tree is not a centred row.
    fn captions_mm(&self, parts: &[DrawingPart]) -> [f64; 2] {
        match self {
            Tree::Group { along: BoxDirection::Row, centred: true, children, .. } => {
                let all = children.iter().filter_map(|c| c.caption_mm(parts));
                all.fold([0.0; 2], |[a, b], [above, below]| [a.max(above), b.max(below)])
            }
            Tree::Group { .. } | Tree::Leaf(_) | Tree::Air(_) => [0.0; 2],
        }
    }

    /// The heights above and below the caption of a drawing.
    fn caption_mm(&self, parts: &[DrawingPart]) -> Option<[f64; 2]> {
        let Tree::Leaf(k) = self else { return None };
        let (y, bounds) = (caption_y(&parts[*k])?, parts[*k].bounds);
        Some([bounds.max.y - y, y - bounds.min.y])
    }

    /// Returns the parts of the tree, in its order.
    fn leaves(&self) -> Vec<usize> {
        match self {
            Tree::Leaf(k) => vec![*k],
            Tree::Air(_) => Vec::new(),
            Tree::Group { children, .. } => children.iter().flat_map(Tree::leaves).collect(),
        }
    }

    /// Places the parts in a box with its upper left corner at `at`.
    pub fn put(&self, parts: &mut [DrawingPart], at: Point) {
        match self {
            Tree::Leaf(k) => parts[*k].stand_at(at),
            Tree::Air(_) => {}
            Tree::Group { along, gap_mm, children, centred } => {
                let [width, height] = self.size(parts);
                let [above, below] = self.captions_mm(parts);
                let mut here = at;
                for c in children {
                    let [w, h] = c.size(parts);
                    if h <= 0.0 {
                        continue;
                    }
                    let part = if *centred { 0.5 } else { 0.0 };
                    match along {
                        BoxDirection::Row => {
                            let own = c.caption_mm(parts).filter(|_| *centred);
                            let down = own.map_or((height - h) * part, |own| {
                                (height - above - below) * part + above - own[0]
                            });
                            c.put(parts, Point::new(here.x, at.y - down));
                            here.x += w + gap_mm;
                        }
                        BoxDirection::Column => {
                            c.put(parts, Point::new(at.x + (width - w) * part, here.y));
                            here.y -= h + gap_mm;
                        }
                    }
                }
            }
        }
    }
}

/// Arranges the parts; returns all items and the size of the paper.
///
/// # Errors
/// `paper-too-small` when a fixed paper does not hold the best arrangement.
pub(super) fn arrange(
    pieces: SheetPieces,
    paper: Option<[f64; 2]>,
    margin_mm: f64,
) -> Result<(Vec<FigureItem>, [f64; 2]), Faults> {
    let layout = SheetLayout::of(pieces);
    let aim = paper.map_or(AIM_MM, |[w, h]| [w - 2.0 * margin_mm, h - 2.0 * margin_mm]);
    let mut best = layout.best(layout.candidates(), aim).expect("there is always an arrangement");
    if layout.scale(&best, aim) > CROWDED {
        let all = layout.candidates().into_iter().chain(layout.in_columns(aim));
        let smallest = all.min_by(|a, b| layout.scale(a, aim).total_cmp(&layout.scale(b, aim)));
        best = smallest.unwrap_or(best);
    }
    let [w, h] = best.size(&layout.parts);
    let size = paper.unwrap_or([w + 2.0 * margin_mm, h + 2.0 * margin_mm]);
    let (free_x, free_y) = (size[0] - w, size[1] - h);
    if free_x < 0.0 || free_y < 0.0 {
        return Err(Diagnostic::error(
            "paper-too-small",
            both!(
                "the sheet needs {w:.0} mm by {h:.0} mm, the paper has {} by {}",
                size[0],
                size[1]
            ),
        )
        .help(both!("give a larger paper, leave its size to the sheet, or ask for less"))
        .into());
    }
    let mut parts = layout.parts;
    best.put(&mut parts, Point::new(free_x / 2.0, size[1] - free_y / 2.0));
    Ok((parts.into_iter().flat_map(|p| p.items).collect(), size))
}

/// Arranges the parts within a width at the least height. The candidates are the textbook
/// arrangements, and rows filled like lines of text. If nothing is narrow enough, the narrowest
/// candidate is taken. Returns all items and the size that they take, without a border.
pub(super) fn arrange_in(pieces: SheetPieces, width_mm: f64) -> (Vec<FigureItem>, [f64; 2]) {
    let layout = SheetLayout::of(pieces);
    let cost = |tree: &Tree| {
        let [w, h] = tree.size(&layout.parts);
        if w <= width_mm { (0.0, h) } else { (w, h) }
    };
    let all = layout.candidates().into_iter().chain(layout.in_rows(width_mm));
    let best =
        all.min_by(|a, b| cost(a).0.total_cmp(&cost(b).0).then(cost(a).1.total_cmp(&cost(b).1)));
    let best = best.expect("there is always an arrangement");
    let size = best.size(&layout.parts);
    let mut parts = layout.parts;
    best.put(&mut parts, Point::new(0.0, size[1]));
    (parts.into_iter().flat_map(|p| p.items).collect(), size)
}

/// Items of a page and the size that they take, without a border.
pub(super) type ArrangedPage = (Vec<FigureItem>, [f64; 2]);

/// Arranges the parts on pages of at most this size: on one page in the arrangement that fills it
/// best, else on as few as possible, with each polygon beside or above its own equations. `heading`
/// returns the title of a page from its number and the number of pages.
///
/// # Errors
/// The size of a part that is larger than a page.
pub(super) fn arrange_on(
    pieces: SheetPieces,
    size: [f64; 2],
    heading: impl Fn(usize, usize) -> Option<DrawingPart>,
) -> Result<Vec<ArrangedPage>, [f64; 2]> {
    let layout = SheetLayout::of(pieces);
    let fits = |tree: &Tree| holds(size, tree.size(&layout.parts));
    let one = layout.candidates().into_iter().chain(layout.in_rows(size[0])).filter(fits);
    let one = layout.best(one, size);
    if let Some(tree) = one {
        let taken = tree.size(&layout.parts);
        let mut parts = layout.parts;
        tree.put(&mut parts, Point::new(0.0, taken[1]));
        return Ok(vec![(parts.into_iter().flat_map(|p| p.items).collect(), taken)]);
    }
    let title_mm = heading(1, 2).map_or(0.0, |title| title.bounds.height_mm() + GAP_MM);
    let below = [size[0], size[1] - title_mm];
    let orders = [(false, false), (true, false), (false, true), (true, true)];
    let mut tried = orders.map(|(narrow, answers_first)| {
        layout.on_pages(below, SheetOrder { narrow, answers_first })
    });
    tried.sort_by_key(|pages| pages.as_ref().map_or(usize::MAX, Vec::len));
    let [pages, ..] = tried;
    let pages = pages?;
    let (count, mut parts) = (pages.len(), layout.parts);
    let set = |(k, rows): (usize, Vec<Tree>)| {
        let title = heading(k + 1, count).map(|title| {
            parts.push(title);
            Tree::Leaf(parts.len() - 1)
        });
        let tree = Tree::column(title.into_iter().chain(rows).collect());
        let taken = tree.size(&parts);
        tree.put(&mut parts, Point::new(0.0, taken[1]));
        let items =
            tree.leaves().into_iter().flat_map(|k| std::mem::take(&mut parts[k].items)).collect();
        (items, taken)
    };
    Ok(pages.into_iter().enumerate().map(set).collect())
}

/// True if a page of this size holds a box of that size.
fn holds(page: [f64; 2], size: [f64; 2]) -> bool {
    size[0] <= page[0] && size[1] <= page[1]
}

/// Breaks blocks, the first `drawings` of them drawings, into rows of at most this width with the
/// least total height: the shortest path from the first block to the last. A wider block gets a row
/// of its own.
fn lines(blocks: Vec<Tree>, drawings: usize, width_mm: f64, parts: &[DrawingPart]) -> Vec<Tree> {
    let sizes: Vec<[f64; 2]> = blocks.iter().map(|tree| tree.size(parts)).collect();
    // For each number of blocks: the least height of their rows, and the index at which the last
    // row begins.
    let mut least = vec![(0.0_f64, 0)];
    for end in 1..=blocks.len() {
        let (mut wide, mut high) = (-GAP_MM, 0.0_f64);
        let mut best = (f64::INFINITY, end - 1);
        for start in (0..end).rev() {
            wide += GAP_MM + sizes[start][0];
            high = high.max(sizes[start][1]);
            if start + 1 < end && wide > width_mm {
                break;
            }
            let height = least[start].0 + high + GAP_MM;
            if height < best.0 {
                best = (height, start);
            }
        }
        least.push(best);
    }
    let mut starts = vec![blocks.len()];
    while let Some(&end) = starts.last().filter(|end| **end > 0) {
        starts.push(least[end].1);
    }
    let mut blocks = blocks.into_iter();
    let rows = starts.iter().rev().zip(starts.iter().rev().skip(1));
    rows.map(|(start, end)| {
        let row = blocks.by_ref().take(end - start).collect();
        if *start < drawings { Tree::row(row) } else { Tree::text_row(row) }
    })
    .collect()
}

/// Places the parts as the tree says and joins them into one.
pub(super) fn put_together(tree: Tree, mut parts: Vec<DrawingPart>) -> DrawingPart {
    tree.put(&mut parts, Point::ORIGIN);
    joined(parts)
}

/// Returns the line of a drawing's caption.
pub(super) fn caption_y(part: &DrawingPart) -> Option<f64> {
    let line = |i: &FigureItem| match &i.shape {
        Shape::Label { at, .. } if i.class == "caption" => Some(at.y),
        _ => None,
    };
    part.items.iter().find_map(line)
}

/// Joins placed parts into one.
pub(super) fn joined(parts: Vec<DrawingPart>) -> DrawingPart {
    DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect())
}

/// Returns the equations of all polygons one below the other, or `None` if there are none.
pub(super) fn column(equations: Vec<(DrawingPart, Vec<DrawingPart>)>) -> Option<DrawingPart> {
    let mut parts = Vec::new();
    let mut tree = Vec::new();
    for (heading, lines) in equations.into_iter().filter(|(_, lines)| !lines.is_empty()) {
        if !tree.is_empty() {
            tree.push(Tree::Air(HEADING_AIR_MM));
        }
        for part in std::iter::once(heading).chain(lines) {
            tree.push(Tree::Leaf(parts.len()));
            parts.push(part);
        }
    }
    let all = put_together(Tree::text_column(tree), parts);
    (!all.items.is_empty()).then_some(all)
}

/// The order of the parts on several pages.
struct SheetOrder {
    /// True if a polygon is above its equations, false if it is beside them.
    narrow: bool,
    /// True if the results follow the mechanism, false if they follow the equations.
    answers_first: bool,
}

struct SheetLayout {
    parts: Vec<DrawingPart>,
    title: Option<usize>,
    drawings: Vec<usize>,
    equations: Vec<Vec<usize>>,
    results: usize,
    forces: Vec<[usize; 3]>,
}

impl SheetLayout {
    fn of(pieces: SheetPieces) -> SheetLayout {
        let mut parts = Vec::new();
        let mut add = |part: DrawingPart| {
            parts.push(part);
            parts.len() - 1
        };
        let title = pieces.title.map(&mut add);
        let drawings: Vec<usize> = pieces.drawings.into_iter().map(&mut add).collect();
        let equations: Vec<Vec<usize>> = pieces
            .equations
            .into_iter()
            .filter(|(_, lines)| !lines.is_empty())
            .map(|(heading, lines)| std::iter::once(heading).chain(lines).map(&mut add).collect())
            .collect();
        let results = add(pieces.results);
        let forces = pieces.forces.into_iter().map(|group| group.map(&mut add)).collect();
        SheetLayout { parts, title, drawings, equations, results, forces }
    }

    /// The parts in their order, in rows: the drawings; the equations, either one column for each
    /// polygon or all in columns side by side; the results. The last candidate has everything one
    /// below the other.
    fn in_rows(&self, width_mm: f64) -> Vec<Tree> {
        let by_level = || {
            self.equations
                .iter()
                .map(|e| Tree::text_column(e.iter().map(|k| Tree::Leaf(*k)).collect()))
                .collect()
        };
        let beside = |columns| vec![Tree::text_row(self.text_columns(columns))];
        let rows = |equations: Vec<Tree>, width_mm: f64| {
            let blocks = self
                .drawings
                .iter()
                .map(|k| Tree::Leaf(*k))
                .chain(equations)
                .chain([Tree::Leaf(self.results)]);
            let blocks = blocks.chain(self.forces.iter().flatten().map(|k| Tree::Leaf(*k)));
            let rows = lines(blocks.collect(), self.drawings.len(), width_mm, &self.parts);
            Tree::column(self.title.map(Tree::Leaf).into_iter().chain(rows).collect())
        };
        let all = std::iter::once(by_level()).chain((1..=4).map(beside));
        all.map(|equations| rows(equations, width_mm)).chain([rows(beside(1), 0.0)]).collect()
    }

    /// The rows of each page below its title.
    ///
    /// # Errors
    /// The size of a row that is larger than a page.
    fn on_pages(&self, page: [f64; 2], order: SheetOrder) -> Result<Vec<Vec<Tree>>, [f64; 2]> {
        let SheetOrder { narrow, answers_first } = order;
        let results = || Tree::Leaf(self.results);
        let mut blocks = vec![Tree::Leaf(self.drawings[0])];
        blocks.extend(answers_first.then(results));
        let levels = self.drawings.len().saturating_sub(1).max(self.equations.len());
        for k in 0..levels {
            let polygon = self.drawings.get(k + 1).map(|k| Tree::Leaf(*k)).into_iter().collect();
            let lines = self.equations.get(k).cloned().unwrap_or_default();
            blocks.extend(self.section(polygon, lines, page, narrow));
        }
        blocks.extend((!answers_first).then(results));
        for [apart, polygon, text] in &self.forces {
            let drawings = vec![Tree::Leaf(*apart), Tree::Leaf(*polygon)];
            blocks.extend(self.section(drawings, vec![*text], page, narrow));
        }
        let mut pages: Vec<Vec<Tree>> = Vec::new();
        let mut left_mm = f64::NEG_INFINITY;
        for row in lines(blocks, 1, page[0], &self.parts) {
            let size = row.size(&self.parts);
            if !holds(page, size) {
                return Err(size);
            }
            if left_mm < size[1] {
                pages.push(Vec::new());
                left_mm = page[1];
            }
            left_mm -= size[1] + GAP_MM;
            pages.last_mut().expect("a page is open").push(row);
        }
        Ok(pages)
    }

    /// Drawings with their lines of text as one block; if that is larger than a page, each drawing
    /// and each column of text as a block of its own.
    fn section(
        &self,
        drawings: Vec<Tree>,
        lines: Vec<usize>,
        page: [f64; 2],
        narrow: bool,
    ) -> Vec<Tree> {
        let lines = [lines];
        let text = |columns| self.columns_of(&lines, columns);
        let whole = |columns: usize| {
            let mut all =
                if drawings.is_empty() { Vec::new() } else { vec![Tree::row(drawings.clone())] };
            if narrow {
                all.push(Tree::text_row(text(columns)));
                Tree::column(all)
            } else {
                all.extend(text(columns));
                Tree::text_row(all)
            }
        };
        let height = |tree: &Tree| tree.size(&self.parts)[1];
        let fits = |tree: &Tree| holds(page, tree.size(&self.parts));
        let columns = if narrow { 1..=1 } else { 1..=3 };
        let least = columns
            .map(whole)
            .filter(|tree| fits(tree))
            .min_by(|a, b| height(a).total_cmp(&height(b)));
        if let Some(block) = least {
            return vec![block];
        }
        let mut columns = (1..=lines[0].len().max(1)).map(text);
        let short = columns.find(|all| all.iter().all(|column| height(column) <= page[1]));
        drawings.into_iter().chain(short.unwrap_or_else(|| text(1))).collect()
    }

    /// The size relative to the page.
    fn scale(&self, tree: &Tree, aim: [f64; 2]) -> f64 {
        let [w, h] = tree.size(&self.parts);
        (w / aim[0]).max(h / aim[1])
    }

    /// The arrangement of least cost.
    fn best(&self, all: impl IntoIterator<Item = Tree>, aim: [f64; 2]) -> Option<Tree> {
        all.into_iter().min_by(|a, b| self.cost(a, aim).total_cmp(&self.cost(b, aim)))
    }

    /// The size relative to the page, plus the weighted empty part of it.
    fn cost(&self, tree: &Tree, aim: [f64; 2]) -> f64 {
        let scale = self.scale(tree, aim);
        let used: f64 = self.parts.iter().map(|p| p.bounds.width_mm() * p.bounds.height_mm()).sum();
        scale + EMPTY_COST * (1.0 - used / (scale * scale * aim[0] * aim[1]))
    }

    fn candidates(&self) -> Vec<Tree> {
        let mut all = Vec::new();
        let leaf = |k: &usize| Tree::Leaf(*k);
        let polygons = || -> Vec<Tree> { self.drawings[1..].iter().map(leaf).collect() };
        let diagram = || Tree::Leaf(self.drawings[0]);
        let results = || Tree::Leaf(self.results);
        for columns in 1..=4 {
            // Drawings above, all text below.
            let mut text = self.text_columns(columns);
            text.push(results());
            all.push(vec![
                Tree::row(self.drawings.iter().map(leaf).collect()),
                Tree::text_row(text),
            ]);
            // Mechanism on the left with the results below it; polygons and equations on the right.
            let right = Tree::column(vec![
                Tree::row(polygons()),
                Tree::text_row(self.text_columns(columns)),
            ]);
            all.push(vec![Tree::text_row(vec![Tree::column(vec![diagram(), results()]), right])]);
            // Mechanism alone on the left; polygons, equations and results on the right.
            let mut text = self.text_columns(columns);
            text.push(results());
            let right = Tree::column(vec![Tree::row(polygons()), Tree::text_row(text)]);
            all.push(vec![Tree::row(vec![diagram(), right])]);
            // All drawings on the left, one below the other; text on the right.
            let mut text = self.text_columns(columns);
            text.push(results());
            all.push(vec![Tree::row(vec![
                Tree::column(self.drawings.iter().map(leaf).collect()),
                Tree::text_row(text),
            ])]);
        }
        // Each polygon above its own equations.
        let mut columns = vec![Tree::column(vec![diagram(), results()])];
        for (k, polygon) in self.drawings[1..].iter().enumerate() {
            let mut column = vec![Tree::Leaf(*polygon)];
            column.extend(
                self.equations.get(k).map(|e| Tree::text_column(e.iter().map(leaf).collect())),
            );
            columns.push(Tree::column(column));
        }
        all.push(vec![Tree::text_row(columns)]);
        self.complete(all)
    }

    /// Arrangements with the title and the forces.
    fn complete(&self, all: Vec<Vec<Tree>>) -> Vec<Tree> {
        let with = |rest: Vec<Tree>| {
            Tree::column(self.title.map(Tree::Leaf).into_iter().chain(rest).collect())
        };
        let forces = self.forces();
        if forces.is_empty() {
            return all.into_iter().map(with).collect();
        }
        let both = |rest: &Vec<Tree>, forces: &Tree| {
            let beside = Tree::row(vec![Tree::column(rest.clone()), forces.clone()]);
            let below = rest.iter().cloned().chain([forces.clone()]).collect();
            [with(vec![beside]), with(below)]
        };
        all.iter().flat_map(|rest| forces.iter().flat_map(|forces| both(rest, forces))).collect()
    }

    /// The forces of all groups: each group in one row, or in two rows in columns side by side.
    fn forces(&self) -> Vec<Tree> {
        if self.forces.is_empty() {
            return Vec::new();
        }
        let drawings = |[apart, polygon, _]: [usize; 3]| {
            Tree::row(vec![Tree::Leaf(apart), Tree::Leaf(polygon)])
        };
        let pair = |group: &[usize; 3]| [drawings(*group), Tree::Leaf(group[2])];
        let rows = Tree::column(
            self.forces.iter().map(|group| Tree::row(group.map(Tree::Leaf).into())).collect(),
        );
        let columns = |n: usize| {
            let column =
                |groups: &[[usize; 3]]| Tree::column(groups.iter().flat_map(pair).collect());
            Tree::text_row(self.forces.chunks(self.forces.len().div_ceil(n)).map(column).collect())
        };
        vec![rows, columns(1), columns(2), columns(3)]
    }

    /// Splits all equations into `columns` columns of about the same height. A column never begins
    /// with the last line of a polygon.
    fn text_columns(&self, columns: usize) -> Vec<Tree> {
        self.columns_of(&self.equations, columns)
    }

    fn columns_of(&self, equations: &[Vec<usize>], columns: usize) -> Vec<Tree> {
        let lines: Vec<usize> = equations.iter().flatten().copied().collect();
        let height = |k: &usize| self.parts[*k].bounds.height_mm() + LINE_GAP_MM;
        let total: f64 = lines.iter().map(height).sum();
        let mut out: Vec<Vec<Tree>> = vec![Vec::new()];
        let mut done = 0.0;
        for (n, k) in lines.iter().enumerate() {
            let h = height(k);
            let heading = equations.iter().any(|e| e[0] == *k);
            // A line goes to the column that holds its middle; a heading goes with the line after
            // it.
            let middle = done
                + if heading { h + lines.get(n + 1).map_or(0.0, height) / 2.0 } else { h / 2.0 };
            let column = ((middle / total * columns as f64) as usize).min(columns - 1);
            if column >= out.len() {
                out.push(Vec::new());
            }
            let column = out.last_mut().expect("there is a column");
            if heading && !column.is_empty() {
                column.push(Tree::Air(HEADING_AIR_MM));
            }
            column.push(Tree::Leaf(*k));
            done += h;
        }
        out.into_iter().filter(|c| !c.is_empty()).map(Tree::text_column).collect()
    }
}
