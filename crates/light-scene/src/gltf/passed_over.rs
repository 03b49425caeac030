//! Members that are left out without a word, because a picture by light transport needs none.

use serde_json::Value;

use super::document::Document;
use super::item::Item;

impl Document {
    /// Leaves out the member `name` of `owner`, a reference to a texture, and the texture with its
    /// image: whatever is wrong with them does not matter.
    pub(super) fn pass_over(&self, owner: &Item<'_>, name: &str) {
        let Ok(Some(info)) = owner.get(name) else {
            return;
        };
        self.ask_all(info.value);
        let texture = info.get("index").ok().flatten();
        let texture = texture.and_then(|index| index.target("textures").ok());
        let Some((_, texture)) = texture else {
            return;
        };
        self.ask_all(texture.value);
        let image = texture.get("source").ok().flatten();
        let image = image.and_then(|source| source.target("images").ok());
        if let Some((_, image)) = image {
            self.ask_all(image.value);
            let view = image.get("bufferView").ok().flatten();
            if let Some((_, view)) = view.and_then(|view| view.target("bufferViews").ok()) {
                self.ask_all(view.value);
            }
        }
        let sampler = texture.get("sampler").ok().flatten();
        if let Some((_, sampler)) = sampler.and_then(|it| it.target("samplers").ok()) {
            self.ask_all(sampler.value);
        }
    }

    /// Counts a value and all in it as read.
    pub(super) fn ask_all(&self, value: &Value) {
        self.visited.borrow_mut().insert(core::ptr::from_ref(value));
        match value {
            Value::Object(members) => members.values().for_each(|value| self.ask_all(value)),
            Value::Array(elements) => elements.iter().for_each(|value| self.ask_all(value)),
            _ => {}
        }
    }
}

impl Item<'_> {
    /// Counts the members whose names start with one of `names` as read, and the accessors that
    /// they refer to.
    pub(super) fn pass_over_members(&self, names: &[&str]) {
        let Some(members) = self.value.as_object() else {
            return;
        };
        for name in members.keys() {
            if !names.iter().any(|start| name.starts_with(start)) {
                continue;
            }
            let member = self.get(name).ok().flatten();
            let accessor = member.and_then(|member| member.target("accessors").ok());
            if let Some((_, accessor)) = accessor {
                self.document.ask_all(accessor.value);
                let view = accessor.get("bufferView").ok().flatten();
                if let Some((_, view)) = view.and_then(|view| view.target("bufferViews").ok()) {
                    self.document.ask_all(view.value);
                }
            }
        }
    }
}
