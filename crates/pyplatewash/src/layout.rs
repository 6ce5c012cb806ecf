//! `Layout`: the plates and their positions.

use crate::plate::plates;
use crate::value::to_record;
use crate::{argument, arrays, exception};
use numpy::PyArrayDyn;
use platewash::workcell::words::count_with_noun;
use platewash::{Layout, Plate};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};

/// Plates, and what is to be said about them. Base frame, metres.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Layout")]
#[derive(PartialEq)]
pub struct LayoutObject {
    inner: Layout,
}

impl From<Layout> for LayoutObject {
    fn from(inner: Layout) -> Self {
        Self { inner }
    }
}

impl LayoutObject {
    /// The layout of the argument called `layout`, if it is given.
    ///
    /// # Errors
    /// `InputTypeError` for what is no layout.
    pub fn given(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Layout>> {
        let found = argument::maybe::<Self>("layout", value, "a Layout, as place_plates gives it,")?;
        Ok(found.map(|layout| layout.get().inner.clone()))
    }

    /// The layout.
    #[must_use]
    pub fn inner(&self) -> &Layout {
        &self.inner
    }
}

#[pymethods]
impl LayoutObject {
    /// The plates, in the order in which they were drawn or given.
    #[getter]
    fn plates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        plates(py, &self.inner.plates)
    }

    /// Centres of the plates, shape (N, 2) [m].
    #[getter]
    fn centres<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let centres: Vec<f64> = self.inner.plates.iter().flat_map(Plate::centre_xy).collect();
        arrays::array(py, &[self.inner.plates.len(), 2], &centres)
    }

    /// Findings about the plates: one record each; its text states the finding.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for finding in &self.inner.findings {
            list.append(to_record(py, finding, Some(finding.to_string()))?)?;
        }
        Ok(list)
    }

    /// Source of the positions: drawn, with restarts and draws, or given.
    #[getter]
    fn source<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.source, None)
    }

    fn __len__(&self) -> usize {
        self.inner.plates.len()
    }

    fn __repr__(&self) -> String {
        let plates = count_with_noun(self.inner.plates.len(), "plate");
        format!(
            "Layout({plates}, {})",
            count_with_noun(self.inner.findings.len(), "finding")
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let text = serde_json::to_string(&slf.get().inner).map_err(|e| exception::internal(py, &e.to_string()))?;
        Ok((slf.get_type().getattr("_restore")?, (text,).into_pyobject(py)?))
    }

    /// Restores a pickled layout.
    #[classmethod]
    fn _restore(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "a pickled layout")?;
        let inner = serde_json::from_str(&text).map_err(|e| exception::input(py, "text", &e.to_string()))?;
        Ok(Self { inner })
    }
}
