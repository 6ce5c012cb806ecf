//! The syntax tree. Chains of operators, accesses and branches are lists, so that its depth is that of the nesting in the text.

use super::token::At;
use std::rc::Rc;

/// A name.
#[derive(Debug, Clone)]
pub struct Name {
    /// As written.
    pub text: Rc<str>,
    /// In small letters: names that differ in case are one.
    pub key: Rc<str>,
    /// Where.
    pub at: At,
}

/// A module.
#[derive(Debug, Clone)]
pub struct Module {
    /// Its name.
    pub name: Name,
    /// `SYSMODULE`, `NOVIEW` and the like.
    pub attributes: Vec<&'static str>,
    /// Types.
    pub types: Vec<TypeDefinition>,
    /// Data.
    pub data: Vec<Data>,
    /// Procedures, functions, traps.
    pub routines: Vec<Routine>,
}

/// Who can see a declaration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// The whole task, and others where it is persistent.
    Global,
    /// The whole task.
    Task,
    /// The module.
    Local,
}

/// A type of its own.
#[derive(Debug, Clone)]
pub struct TypeDefinition {
    /// Who can see it.
    pub scope: Scope,
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: TypeKind,
}

/// What a type is.
#[derive(Debug, Clone)]
pub enum TypeKind {
    /// Components, each with its type.
    Record(Vec<(Name, Name)>),
    /// Another name of a type.
    Alias(Name),
}

/// How data are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// Never changed.
    Const,
    /// While the program runs.
    Var,
    /// For ever.
    Pers,
}

/// A declaration of data.
#[derive(Debug, Clone)]
pub struct Data {
    /// Who can see them.
    pub scope: Scope,
    /// How they are kept.
    pub storage: Storage,
    /// Their type.
    pub type_name: Name,
    /// Their name.
    pub name: Name,
    /// Sizes of an array.
    pub dims: Vec<Expression>,
    /// What they begin with.
    pub value: Option<Expression>,
}

/// What a routine is.
#[derive(Debug, Clone)]
pub enum RoutineKind {
    /// A procedure.
    Proc,
    /// A function of that type.
    Func(Name),
    /// A trap.
    Trap,
}

/// A routine.
#[derive(Debug, Clone)]
pub struct Routine {
    /// Who can see it.
    pub scope: Scope,
    /// What it is.
    pub kind: RoutineKind,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Its own data.
    pub data: Vec<Data>,
    /// What it does.
    pub body: Vec<Statement>,
    /// What it does otherwise.
    pub handlers: Vec<Handler>,
}

/// When a handler is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HandlerKind {
    /// After an error.
    Error,
    /// When the routine is left for good.
    Undo,
    /// When the program is run backwards.
    Backward,
}

/// What a routine does otherwise.
#[derive(Debug, Clone)]
pub struct Handler {
    /// When.
    pub kind: HandlerKind,
    /// Error numbers that it is for; all where empty.
    pub errors: Vec<Expression>,
    /// What it does.
    pub body: Vec<Statement>,
}

/// How an argument reaches its routine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Passing {
    /// As a value.
    In,
    /// As the variable or persistent itself.
    InOut,
    /// As the variable itself.
    Var,
    /// As the persistent itself.
    Pers,
}

/// Whether an argument must be there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// It must.
    Required,
    /// It need not.
    Optional,
    /// It need not, and has no value.
    Switch,
}

/// A parameter.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// How it is passed.
    pub passing: Passing,
    /// Whether it must be there.
    pub presence: Presence,
    /// Its type.
    pub type_name: Name,
    /// Its name.
    pub name: Name,
    /// How many indices it has.
    pub dims: usize,
}

/// A statement.
#[derive(Debug, Clone)]
pub struct Statement {
    /// Where it begins.
    pub at: At,
    /// What it is.
    pub kind: StatementKind,
}

/// What a statement is.
#[derive(Debug, Clone)]
pub enum StatementKind {
    /// `a := b;`
    Assign(Designator, Expression),
    /// `Name arguments;`
    Call(Name, Vec<Argument>),
    /// `%"name"% arguments;`
    LateCall(Expression, Vec<Argument>),
    /// `IF`, with its branches and what is done otherwise.
    If(Vec<(Expression, Vec<Statement>)>, Vec<Statement>),
    /// `FOR`.
    For(Box<For>),
    /// `WHILE`.
    While(Expression, Vec<Statement>),
    /// `TEST`, with its cases and what is done otherwise.
    Test(Expression, Vec<(Vec<Expression>, Vec<Statement>)>, Vec<Statement>),
    /// `GOTO`.
    Goto(Name),
    /// A label.
    Label(Name),
    /// `RETURN`.
    Return(Option<Expression>),
    /// `EXIT`.
    Exit,
    /// `RAISE`.
    Raise(Option<Expression>),
    /// `RETRY`.
    Retry,
    /// `TRYNEXT`.
    TryNext,
    /// `CONNECT variable WITH trap`.
    Connect(Designator, Name),
}

/// A loop that counts.
#[derive(Debug, Clone)]
pub struct For {
    /// What counts.
    pub name: Name,
    /// From.
    pub from: Expression,
    /// To, which is counted, too.
    pub to: Expression,
    /// Step; without it ±1, towards the end.
    pub step: Option<Expression>,
    /// What is done each time.
    pub body: Vec<Statement>,
}

/// An argument of a call.
#[derive(Debug, Clone)]
pub enum Argument {
    /// In its place.
    Required(Expression),
    /// `\Name` or `\Name:=value`.
    Optional(Name, Option<Expression>),
    /// `\Name?parameter`: there if that parameter is.
    Passed(Name, Name),
}

/// An expression.
#[derive(Debug, Clone)]
pub struct Expression {
    /// Where it begins.
    pub at: At,
    /// What it is.
    pub kind: ExpressionKind,
}

/// What an expression is.
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// A number.
    Number(f64),
    /// A string.
    Text(Rc<str>),
    /// `TRUE` or `FALSE`.
    Truth(bool),
    /// Data, or a part of them.
    Read(Designator),
    /// A function's result.
    Call(Name, Vec<Argument>),
    /// An aggregate.
    List(Vec<Expression>),
    /// Operators of one rank, from left to right.
    Chain(Box<Expression>, Vec<(Operator, Expression)>),
    /// `-a`.
    Negative(Box<Expression>),
    /// `NOT a`.
    Not(Box<Expression>),
}

/// Data, or a part of them.
#[derive(Debug, Clone)]
pub struct Designator {
    /// The data.
    pub name: Name,
    /// The way to the part.
    pub path: Vec<Access>,
}

/// A step to a part of data.
#[derive(Debug, Clone)]
pub enum Access {
    /// `{i, j}`.
    Index(Vec<Expression>),
    /// `.name`.
    Component(Name),
}

/// An operator between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the operator that it is named after")]
pub enum Operator {
    Times,
    Over,
    Div,
    Mod,
    Plus,
    Minus,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    Unequal,
    And,
    Or,
    Xor,
}
