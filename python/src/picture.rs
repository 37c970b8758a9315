//! Figures and documents, and their files.

use crate::fault::Refusal;
use crate::work::run;
use hodograph::diag::{Faults, Warned};
use hodograph::paper::item::Figure;
use hodograph::paper::words::words;
use hodograph::render::svg::IdPrefix;
use hodograph::render::{pdf, png, svg};
use hodograph::worksheet::{CompanionFile, Document, html, markdown, pages, typst};
use pyo3::prelude::*;

/// A figure.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Picture {
    figure: Figure,
}

impl Picture {
    /// Returns the picture of a figure.
    pub fn of(figure: Figure) -> Picture {
        Picture { figure }
    }

    fn markup(&self, editable: bool) -> Result<Warned<String>, Faults> {
        if editable { svg::write_editable(&self.figure) } else { svg::write(&self.figure) }
    }
}

#[pymethods]
impl Picture {
    /// Width and height (mm).
    #[getter]
    fn size_mm(&self) -> (f64, f64) {
        (self.figure.width_mm, self.figure.height_mm)
    }

    /// Returns the figure as SVG with a prefix before its ids; with `editable`, letters are text.
    #[pyo3(signature = (editable=false, prefix=""))]
    fn svg(&self, py: Python, editable: bool, prefix: &str) -> PyResult<String> {
        run(py, || {
            let prefix = IdPrefix::new(prefix)?;
            Ok(prefix.put_before(&self.markup(editable)?.value).into_owned())
        })
    }

    /// Returns the figure as PNG.
    fn png(&self, py: Python, dpi: f64) -> PyResult<Vec<u8>> {
        run(py, || Ok(png::render(&self.markup(false)?.value, dpi)?))
    }
}

/// Returns figures as a PDF with a page for each.
#[pyfunction]
pub fn pdf_of(py: Python, pictures: Vec<Py<Picture>>) -> PyResult<Vec<u8>> {
    let figures: Vec<Figure> = pictures.iter().map(|p| p.get().figure.clone()).collect();
    run(py, || Ok(pdf::pdf(&figures)?.value))
}

/// A worksheet.
#[pyclass(frozen, module = "hodograph._native")]
pub struct Sheet {
    document: Document,
}

impl Sheet {
    /// Returns the sheet of a document.
    pub fn of(document: Document) -> Sheet {
        Sheet { document }
    }
}

/// A text with the files beside it, by name.
type Written = (String, Vec<(String, String)>);

fn written((text, beside): (String, Vec<CompanionFile>)) -> Written {
    (text, beside.into_iter().map(|f| (f.name, f.text)).collect())
}

#[pymethods]
impl Sheet {
    /// The title.
    #[getter]
    fn title(&self) -> &str {
        &self.document.title
    }

    /// Returns the document as one HTML page.
    fn html(&self, py: Python) -> PyResult<String> {
        run(py, || html::html(&self.document).map_err(Refusal::of))
    }

    /// Returns the document as Markdown, with its drawings; their names begin with `stem`.
    fn markdown(&self, py: Python, stem: &str) -> PyResult<Written> {
        run(py, || Ok(written(markdown::markdown(&self.document, stem)?)))
    }

    /// Returns the document for Typst, with its drawings; their names begin with `stem`.
    fn typst(&self, py: Python, stem: &str) -> PyResult<Written> {
        run(py, || Ok(written(typst::typst(&self.document, stem)?)))
    }

    /// Returns the document as PDF.
    fn pdf(&self, py: Python) -> PyResult<Vec<u8>> {
        run(py, || {
            let Document { title, lang, .. } = &self.document;
            Ok(pdf::document(&pages::pages(&self.document), title, words(*lang).tag)?.value)
        })
    }
}
