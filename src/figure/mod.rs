//! The figure as typed items in millimetres of paper.
