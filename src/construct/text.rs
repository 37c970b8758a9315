//! construction words
